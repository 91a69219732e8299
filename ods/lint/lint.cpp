// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/lint/lint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "ods/base/error.h"
#include "ods/lint/checks.h"
#include "ods/picture/load_eyes.h"

namespace ods {

void judge(LintReport& report, Check check) {
  report.judged.push_back(check);
}

void skip(LintReport& report, Check check, const std::string& reason) {
  report.not_judged.push_back({check, reason});
}

bool has_finding(const LintReport& report, Severity severity, double certainty) {
  return std::any_of(report.findings.begin(), report.findings.end(), [&](const Finding& finding) {
    return severity_of(finding.fault) <= severity && finding.certainty >= certainty;
  });
}

// --- the subject ---------------------------------------------------------------------------------------------------

// Cuts packed eyes here, so that the file can be cut in other ways too.
static void load(Subject& subject, const LintOptions& options) {
  const std::string& path = subject.path;
  subject.info = read_info(names_eye(path) ? path_for_eye(path, kLeft) : path);
  OpenOptions open;
  open.format.layout = options.layout;
  open.format.projection = options.projection;
  open.color_only = true;
  subject.format = find_format(subject.info, path, open.format);
  if (names_eye(path) || subject.format.is_photo || subject.layout() == Layout::kMultiview) {
    subject.eyes = grey_eyes(open_picture(path, open));
    return;
  }
  const Extent size{subject.info.width, subject.info.height};
  if (!unpacked_size(subject.layout(), size)) {
    throw Error(ErrorKind::kInput, fmt::format("cannot read '{}': {}x{} pixels are not two eyes, {}; say --layout",
                                               path, size.width, size.height, layout_name(subject.layout())));
  }
  open.format.layout = Layout::kSeparate;
  open.format.projection = ProjectionSetting();  // any: the pixels are taken as stored
  subject.packed = grey_eyes(open_picture(path, open))[0];
  subject.eyes = unpack(subject.layout(), subject.packed);
}

static void load_sidecar(Subject& subject) {
  const std::string path = sidecar_path(subject.path);
  std::vector<std::string> warnings;
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) subject.sidecar = load_sidecar(path, warnings);
}

static void find_camera(Subject& subject) {
  if (subject.format.has_camera) subject.camera = make_camera(subject.format.camera);
}

static void describe(const Subject& subject, LintReport& report) {
  const Image& eye = subject.eyes[0];
  report.file = {subject.info.width, subject.info.height};
  report.eye = {eye.width, eye.height};
  report.eye_count = static_cast<int>(subject.eyes.size());
  if (report.eye_count > 1) report.layout = subject.format.layout.layout;
  report.reason = subject.format.layout.reason;
  report.projection = projection_name(subject.projection());
  int64_t not_finite = 0;
  for (const Image& each : subject.eyes) {
    not_finite +=
        std::count_if(each.pixels.begin(), each.pixels.end(), [](float value) { return !std::isfinite(value); });
  }
  if (not_finite > 0) report.notes.push_back(fmt::format("{} values are NaN or infinite", not_finite));
  if (!subject.info.color_fault.empty()) report.notes.push_back(subject.info.color_fault);
}

// --- the checks ----------------------------------------------------------------------------------------------------

constexpr double kMinAround = 256.0;  // pixels of an eye per 360 degrees
constexpr int kMinHeight = 32;

static void check_pixels(const Subject& subject, LintReport& report) {
  check_seam(subject, report);
  if (report.eye_count < 2 || subject.format.camera.head_tilt_map) return;
  check_parallax(subject, report);
  check_poles(subject, report);
}

// Reports the checks that were not reached.
static void skip_the_rest(LintReport& report, const std::string& reason) {
  const auto is_done = [&](Check check) {
    return std::find(report.judged.begin(), report.judged.end(), check) != report.judged.end() ||
           std::any_of(report.not_judged.begin(), report.not_judged.end(),
                       [&](const NotJudged& each) { return each.check == check; });
  };
  for (const Check check : kChecks) {
    if (!is_done(check)) skip(report, check, reason);
  }
  const auto order = [](const NotJudged& a, const NotJudged& b) { return a.check < b.check; };
  std::sort(report.judged.begin(), report.judged.end());
  std::stable_sort(report.not_judged.begin(), report.not_judged.end(), order);
}

LintReport lint(const std::string& path, const LintOptions& options) {
  Subject subject;
  LintReport report;
  subject.path = path;
  load(subject, options);
  load_sidecar(subject);
  find_camera(subject);
  describe(subject, report);
  const double around = 2.0 * std::numbers::pi * pixels_per_radian(subject.projection(), report.eye.width);
  const bool small = around < kMinAround || report.eye.height < kMinHeight;
  std::string reason = "there is only one eye";
  if (report.eye_count > 1) skip(report, Check::kBetweenEyes, "ods lint does not measure them yet");
  if (subject.format.camera.head_tilt_map) reason = "its head-tilt map turns the parallax";
  if (small) reason = fmt::format("an eye of {}x{} pixels is too small", report.eye.width, report.eye.height);
  if (small || check_layout(subject, report)) {
    check_metadata(subject, report);
    check_shape(subject, report);
    if (!small) check_pixels(subject, report);
  } else {
    reason = "the layout must be right first";
  }
  skip_the_rest(report, reason);
  std::stable_sort(report.findings.begin(), report.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.certainty > b.certainty; });
  return report;
}

}  // namespace ods
