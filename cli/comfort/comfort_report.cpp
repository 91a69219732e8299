// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/comfort/comfort_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/console/print.h"
#include "cli/options/eye_options.h"

using ods::ComfortLevel, ods::ComfortReport, ods::ComfortRules, ods::Strain, ods::StrainedPlace;
using Json = nlohmann::ordered_json;

namespace {

std::string shares_text(const std::array<double, 4>& shares) {
  std::string text;
  for (const ComfortLevel level : ods::kComfortLevels) {
    text += fmt::format("{}{} {}", level == ComfortLevel::kOk ? "" : ", ", comfort_level_name(level),
                        share_text(shares[static_cast<size_t>(level)]));
  }
  return text;
}

void print_place(const StrainedPlace& place) {
  const std::string cure = cure_text(place);
  const ods::StrainRow& strain = ods::strain_row(place.strain);
  put_out(fmt::format("{}: {}, {:.2f} m away, {} ({} of the picture): {}, {:.3g} {}{}{}\n",
                      comfort_level_name(place.level), thing_text(place), place.distance, direction_text(place),
                      share_text(place.share), strain.title, place.value, strain.unit, cure.empty() ? "" : "; ", cure));
}

Json shares_json(const std::array<double, 4>& shares) {
  Json json;
  for (const ComfortLevel level : ods::kComfortLevels) {
    json[comfort_level_name(level)] = shares[static_cast<size_t>(level)];
  }
  return json;
}

Json place_json(const StrainedPlace& place) {
  return {{"name", place.name},
          {"level", comfort_level_name(place.level)},
          {"strain", ods::strain_row(place.strain).name},
          {"value", place.value},
          {"unit", ods::strain_row(place.strain).unit},
          {"azimuth", place.azimuth},
          {"elevation", place.elevation},
          {"distance", place.distance},
          {"enough", place.enough},
          {"ipd", place.ipd},
          {"share", place.share}};
}

}  // namespace

std::string direction_text(const StrainedPlace& place) {
  return ods::direction_text(place.azimuth, place.elevation);
}

std::string thing_text(const StrainedPlace& place) {
  return place.name.empty() ? "an area" : "'" + place.name + "'";
}

std::string share_text(double share) {
  return share > 0.0 && share < 0.001 ? "<0.1 %" : fmt::format("{:.1f} %", 100.0 * share);
}

std::string cure_text(const StrainedPlace& place) {
  if (place.level < ComfortLevel::kWarning) return "";
  std::string text = fmt::format("{:.2f} m would do", place.enough);
  if (place.strain != Strain::kRule) text += fmt::format(", or --ipd {:.3f}", std::floor(1e3 * place.ipd) / 1e3);
  return text;
}

std::string measured_text(const ods::MeasuredEyes& eyes) {
  std::string text = "No word says how the eyes were placed; measured from the pixels: ";
  const ods::StereoCamera& camera = eyes.camera;
  text += camera.convergence == ods::kParallel
              ? fmt::format("eyes {:.3g} m apart", camera.ipd)
              : fmt::format("eyes {:.3g} m apart that converge at {:.3g} m", camera.ipd, camera.convergence_distance);
  if (!eyes.is_known) return text;
  text += eyes.is_merged ? ", a pole merge with " + merge_curve_text(*camera.merge_map) : ", no pole merge";
  return text + fmt::format(" (+-{:.0f} %, measured up to {:.0f} degrees up and {:.0f} down)",
                            std::max(1.0, 100.0 * eyes.error), eyes.up, eyes.down);
}

std::vector<std::string> cure_lines(const ComfortJob& job, const Looked& looked, const ComfortReport& report) {
  std::vector<std::string> lines;
  for (const std::string& name : looked.hidden) {
    lines.push_back(
        fmt::format("'{}' reaches into the circle of the eyes, where nothing is seen: move it, or the camera", name));
  }
  if (ods::worst_level(report) < ComfortLevel::kWarning) return lines;
  const bool is_rule = job.comfort.rules != ComfortRules::kStrain;
  lines.push_back("move these things, or the camera" +
                  (is_rule ? ""
                           : fmt::format("; or --ipd {:.3g} instead of {:.3g}",
                                         std::floor(1e3 * double{report.largest_ipd}) / 1e3, looked.camera.ipd)));
  const double limit = ods::strain_limits(Strain::kVertical, job.comfort.viewer).warning;
  if (report.most[static_cast<size_t>(Strain::kVertical)] > limit) {
    lines.push_back("of what is above or below: --merge auto, as much stereo as the distances there allow");
  }
  return lines;
}

// --- for people and for programs -------------------------------------------------------------------------------------

void print_text(const ComfortJob& job, const Looked& looked, const ComfortReport& report) {
  put_out(fmt::format("{}: {}; eyes {:.3g} m apart, nearest {:.2f} m\n", job.scene.name,
                      comfort_level_name(verdict(job, looked, report)), looked.camera.ipd, report.nearest));
  if (!looked.why_matched.empty()) put_out(fmt::format("{}: judged by matching them\n", looked.why_matched));
  if (looked.measured) put_out(fmt::format("{}\n", measured_text(*looked.measured)));
  if (looked.match) {
    put_out(fmt::format("by matching: +-{:.0f} minutes of arc; {:.0f} % of the picture could be matched\n",
                        looked.match->precision, 100.0 * looked.match->share));
    if (const ComfortLevel level = apart_level(job, *looked.match); level > ComfortLevel::kOk) {
      put_out(
          fmt::format("{}: one eye sees things {:.0f} minutes of arc higher than the other: ods lint has the cure\n",
                      comfort_level_name(level), looked.match->apart));
    }
  }
  put_out(fmt::format("{} of the picture, by solid angle; where people look: {}\n", shares_text(report.share),
                      shares_text(report.looked)));
  if (report.head_roll > 0.0 && report.head_roll < 89.0) {
    put_out(
        fmt::format("a head may tilt sideways by {:.2g} degrees before the eyes must turn apart vertically too far\n",
                    report.head_roll));
  }
  for (const StrainedPlace& place : report.places) print_place(place);
  for (const std::string& cure : cure_lines(job, looked, report)) put_out(fmt::format("cure: {}\n", cure));
}

void print_json(const ComfortJob& job, const Looked& looked, const ComfortReport& report) {
  const ods::Viewer& viewer = job.comfort.viewer;
  Json json = {{"path", job.scene.name},      {"level", comfort_level_name(verdict(job, looked, report))},
               {"ipd", looked.camera.ipd},    {"viewer_ipd", viewer.ipd},
               {"gaze", viewer.gaze_degrees}, {"roll", viewer.roll_degrees}};
  json["focus"] = std::isfinite(viewer.focus) ? Json(viewer.focus) : Json("infinity");
  json["nearest"] = std::isfinite(report.nearest) ? Json(report.nearest) : Json();
  json["unknown"] = report.unknown;
  if (looked.match) {
    json["matched"] = {
        {"share", looked.match->share}, {"precision", looked.match->precision}, {"apart", looked.match->apart}};
    if (!looked.why_matched.empty()) json["matched"]["why"] = looked.why_matched;
  }
  if (looked.measured) {
    const ods::MeasuredEyes& eyes = *looked.measured;
    json["measured"] = {{"merged", eyes.is_known ? Json(eyes.is_merged) : Json()},
                        {"convergence", ods::convergence_name(eyes.camera.convergence)},
                        {"error", eyes.error},
                        {"up", eyes.up},
                        {"down", eyes.down}};
    if (eyes.is_merged) {
      for (int row = 0; row < eyes.camera.merge_map->height; row++) {
        json["measured"]["shares"].push_back(*eyes.camera.merge_map->at(0, row));
      }
    }
  }
  json["largest_ipd"] = report.largest_ipd;
  json["head_roll"] = report.head_roll;
  json["share"] = shares_json(report.share), json["looked"] = shares_json(report.looked);
  for (const ods::StrainRow& strain : ods::kStrainTable) {
    const bool is_rule = strain.member == Strain::kRule;
    if (is_rule == (job.comfort.rules == ComfortRules::kStrain)) continue;
    json["most"][strain.name] = report.most[static_cast<size_t>(strain.member)];
  }
  json["places"] = Json::array();
  for (const StrainedPlace& place : report.places) json["places"].push_back(place_json(place));
  json["hidden"] = looked.hidden;
  put_json(json);
}

ComfortLevel apart_level(const ComfortJob& job, const MatchQuality& match) {
  return ods::level_of(match.apart, ods::strain_limits(Strain::kVertical, job.comfort.viewer));
}

ComfortLevel verdict(const ComfortJob& job, const Looked& looked, const ComfortReport& report) {
  const ComfortLevel level = ods::worst_level(report);
  return looked.match ? std::max(level, apart_level(job, *looked.match)) : level;
}
