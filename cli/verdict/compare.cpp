// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods compare: measures the difference between two pictures.
#include "ods/image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/options/picture_options.h"
#include "cli/verdict/compare_report.h"
#include "ods/base/error.h"
#include "ods/kernel/camera/camera.h"
#include "ods/picture/save.h"

using ods::Image, ods::LoadedEyes;

namespace {

constexpr const char* kCompareExamples =
    "  ods compare reference.exr picture.exr\n"
    "  ods compare a_%V.png b_TB.png --diff difference.exr\n"
    "  ods compare reference.png picture.jpg --min-psnr 40 || echo too different";

constexpr const char* kCompareSummary =
    "Measures the difference between pictures A and B: RMSE, PSNR, WS-PSNR (rows weighted by their area on the "
    "sphere)\n"
    "and the largest error and its place, per eye and overall. Two integer files are compared as code values from 0 "
    "to\n"
    "1, all others in linear light; the peak is 1. Exit code 5: a limit was exceeded.";

struct CompareJob {
  std::string a, b;
  std::optional<ods::Layout> layout;
  std::string difference;
  bool json = false;
  std::optional<float> max_rmse, min_psnr, max_error;
};

CompareJob parse_compare(Options& options) {
  CompareJob job;
  options.describe(kCompareSummary, kCompareExamples);
  options.argument(ValueKind::input_file("A"), job.a, "a picture; %V in the name: one file per eye");
  options.argument(ValueKind::input_file("B"), job.b, "a picture of the same size; its layout may differ");
  add_input_layout_option(options, job.layout, "layout of both files, if it is not detected");
  options.text("--diff", ValueKind::output_file(), job.difference,
               "write a picture of the difference, left eye on top: .exr holds B - A; other formats hold |B - A|, "
               "scaled so that the largest value is white");
  options.group("Limits, for scripts");
  options.number("--max-rmse", job.max_rmse, 0.0f, 1e30f, "limit of the RMSE of all eyes");
  options.number("--min-psnr", job.min_psnr, -1e4f, 1e4f, "limit of the PSNR of all eyes, dB");
  options.number("--max-error", job.max_error, 0.0f, 1e30f, "limit of the largest error of any value");
  options.group("Console");
  options.flag("--json", job.json, "print JSON");
  add_console_options(options);
  options.parse();
  return job;
}

void encode(LoadedEyes& file) {
  for (Image& eye : file.eyes) {
    for (float& value : eye.pixels) value = ods::srgb_encode(value);
  }
}

CompareReport compare(const CompareJob& job) {
  CompareReport report;
  report.paths = {job.a, job.b};
  auto& [a, b] = report.files;
  a = ods::load_eyes(job.a, job.layout);
  b = ods::load_eyes(job.b, job.layout);
  for (size_t i = 0; i < 2; i++) {
    const std::string& fault = report.files[i].color_fault;
    if (!fault.empty()) warn(fmt::format("'{}': {}", report.paths[i], fault));
  }
  if (a.projection != b.projection) {
    note(fmt::format("'{}' is {}, '{}' is {}: comparing pixel by pixel anyway", job.a, a.projection, job.b,
                     b.projection));
  }
  report.in_code_values = !a.is_float && !b.is_float;
  if (a.is_float != b.is_float) {
    note(
        "one file is scene-linear, the other display-encoded: a tone curve between them counts as a difference "
        "(render with --tone linear to leave it out)");
  }
  if (report.in_code_values) {
    encode(a);
    encode(b);
  }
  report.comparison = ods::compare_eyes(a.eyes, b.eyes, {fmt::format("'{}'", job.a), fmt::format("'{}'", job.b)});
  if (!a.variance.empty() && !b.variance.empty()) report.z = z_test(a.eyes, b.eyes, a.variance, b.variance);
  return report;
}

void write_difference(const CompareReport& report, const std::string& path) {
  const bool is_signed = ods::format_of_path(path) == ods::FileFormat::kExr;
  const double largest = report.comparison.whole.largest.error;
  const float scale = largest > 0.0 ? static_cast<float>(1.0 / largest) : 1.0f;
  ods::Picture picture;
  const size_t count = report.comparison.eyes.size();
  for (size_t i = 0; i < count; i++) {
    ods::EyeImage eye;
    eye.eye = count == 1 ? ods::kMono : i == 0 ? ods::kLeft : ods::kRight;
    eye.radiance = ods::difference(report.files[0].eyes[i], report.files[1].eyes[i]);
    // Scaled in code values; saving encodes it again.
    for (float& value : eye.radiance.pixels) value = is_signed ? value : ods::srgb_decode(scale * std::abs(value));
    picture.eyes.push_back(std::move(eye));
  }
  ods::SaveOptions options;
  options.tone = ods::ToneCurve::kLinear;
  save_picture(picture, options, path);
}

// NaN, if nothing could be compared, exceeds every limit.
std::vector<std::string> exceeded_limits(const CompareJob& job, const ods::Errors& whole) {
  std::vector<std::string> exceeded;
  if (job.max_rmse && !(whole.rmse <= *job.max_rmse)) {
    exceeded.push_back(fmt::format("RMSE {:.4g} is above --max-rmse {}", whole.rmse, *job.max_rmse));
  }
  if (job.min_psnr && !(whole.psnr >= *job.min_psnr)) {
    exceeded.push_back(fmt::format("PSNR {:.2f} is below --min-psnr {}", whole.psnr, *job.min_psnr));
  }
  if (job.max_error && !(whole.largest.error <= *job.max_error)) {
    exceeded.push_back(
        fmt::format("the largest error {:.4g} is above --max-error {}", whole.largest.error, *job.max_error));
  }
  const bool limited = job.max_rmse || job.min_psnr || job.max_error;
  if (limited && whole.not_finite > 0) {
    exceeded.push_back(fmt::format("{} pixels are NaN or infinite", whole.not_finite));
  }
  return exceeded;
}

ExitCode run_compare(const CompareJob& job) {
  for (const std::string& input : {job.a, job.b}) refuse_overwriting(job.difference, input);
  CompareReport report = compare(job);
  report.exceeded = exceeded_limits(job, report.comparison.whole);
  job.json ? print_json(report) : print_text(report);
  if (!job.difference.empty()) write_difference(report, job.difference);
  return report.exceeded.empty() ? kExitOk : kExitFault;
}

}  // namespace

extern const Command kCompare =
    make_command<parse_compare, run_compare>("compare", "measure the difference between two pictures");
