// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/verdict/compare_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/console/print.h"
#include "ods/base/json_reader.h"

using ods::Json;

namespace {

const char* eye_token(const CompareReport& report, size_t eye) {
  if (report.comparison.eyes.size() == 1) return "one";
  return eye == 0 ? "left" : "right";
}

bool is_lat_long(const CompareReport& report) {
  return report.files[0].projection == "lat-long" && report.files[1].projection == "lat-long";
}

std::string layout_token(const ods::LoadedEyes& file) {
  return std::string(file.guess.layout ? ods::layout_name(*file.guess.layout) : "one eye");
}

// Degrees to the right of the centre, and up.
struct Direction {
  double azimuth;
  double elevation;
};
Direction direction_of(const CompareReport& report, const ods::LargestError& largest) {
  const ods::Image& eye = report.files[0].eyes[static_cast<size_t>(largest.eye)];
  return {360.0 * ((largest.x + 0.5) / eye.width - 0.5), 180.0 * (0.5 - (largest.y + 0.5) / eye.height)};
}

void print_row(const CompareReport& report, const char* name, const ods::Errors& errors) {
  const ods::LargestError& largest = errors.largest;
  std::string where = "-", direction = "-";
  if (largest.error > 0.0) {
    where = fmt::format("{} {},{} {}", eye_token(report, static_cast<size_t>(largest.eye)), largest.x, largest.y,
                        "RGB"[largest.channel]);
    const Direction at = direction_of(report, largest);
    direction = fmt::format("{:.1f},{:.1f}", at.azimuth, at.elevation);
  }
  put_out(fmt::format("{:<6} {:>10.4g} {:>7.2f} {:>7.2f} {:>10.4g}  {:<18} {:<13} {}\n", name, errors.rmse, errors.psnr,
                      is_lat_long(report) ? errors.ws_psnr : std::nan(""), largest.error, where,
                      is_lat_long(report) ? direction : "-", errors.not_finite));
}

Json to_json(const CompareReport& report, const char* name, const ods::Errors& errors) {
  const ods::LargestError& largest = errors.largest;
  Json json = {{"eye", name}, {"rmse", ods::json_number(errors.rmse)}, {"psnr", ods::json_number(errors.psnr)}};
  if (is_lat_long(report)) json["ws_psnr"] = ods::json_number(errors.ws_psnr);
  json["largest"] = {{"error", largest.error}};
  if (largest.error > 0.0) {
    json["largest"].update({{"eye", eye_token(report, static_cast<size_t>(largest.eye))},
                            {"x", largest.x},
                            {"y", largest.y},
                            {"channel", std::string(1, "RGB"[largest.channel])}});
    const Direction at = direction_of(report, largest);
    if (is_lat_long(report)) json["largest"].update({{"azimuth", at.azimuth}, {"elevation", at.elevation}});
  }
  json["not_finite"] = errors.not_finite;
  return json;
}

}  // namespace

static void print_noise(const std::optional<ods::ZTest>& z) {
  if (!z) return put_out("\nnoise: unknown, because not both files have variance.R, G and B\n");
  put_out(
      fmt::format("\nnoise: z has mean {:.4f} (0 expected), rms {:.4f} (1), beyond 3 {:.3g} % (0.27), largest {:.3g}",
                  z->mean, z->rms, 100.0 * z->beyond_3, z->largest));
  put_out(fmt::format("; {} values differ without any noise\n", z->sure_differences));
}

void print_text(const CompareReport& report) {
  for (size_t i = 0; i < 2; i++) {
    put_out(fmt::format("{} {}: {}, {}\n", "AB"[i], report.paths[i], layout_token(report.files[i]),
                        report.files[i].guess.reason));
  }
  put_out(fmt::format("in {}\n\n", report.in_code_values ? "code values 0..1, display-encoded" : "linear light"));
  put_out(fmt::format("{:<6} {:>10} {:>7} {:>7} {:>10}  {:<18} {:<13} {}\n", "eye", "RMSE", "PSNR", "WS-PSNR",
                      "largest", "at x,y", "degrees", "not finite"));
  const std::vector<ods::Errors>& eyes = report.comparison.eyes;
  for (size_t i = 0; i < eyes.size(); i++) print_row(report, eye_token(report, i), eyes[i]);
  if (eyes.size() > 1) print_row(report, "both", report.comparison.whole);
  print_noise(report.z);
  for (const std::string& limit : report.exceeded) put_out(limit + "\n");
}

void print_json(const CompareReport& report) {
  Json json = {{"in", report.in_code_values ? "code values" : "linear light"}};
  for (size_t i = 0; i < 2; i++) {
    json[i == 0 ? "a" : "b"] = {
        {"path", report.paths[i]}, {"layout", layout_token(report.files[i])}, {"reason", report.files[i].guess.reason}};
  }
  const std::vector<ods::Errors>& eyes = report.comparison.eyes;
  for (size_t i = 0; i < eyes.size(); i++) json["eyes"].push_back(to_json(report, eye_token(report, i), eyes[i]));
  json["whole"] = to_json(report, "all", report.comparison.whole);
  json["exceeded"] = report.exceeded;
  json["z"] = nullptr;
  if (report.z) {
    json["z"] = {{"values", report.z->values},   {"mean", report.z->mean},
                 {"rms", report.z->rms},         {"beyond_3", report.z->beyond_3},
                 {"largest", report.z->largest}, {"sure_differences", report.z->sure_differences}};
  }
  // File names need not be valid UTF-8.
  put_json(json);
}
