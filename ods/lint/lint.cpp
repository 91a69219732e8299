// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/lint/lint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ods/lint/checks.h"

namespace ods {

void judge(LintReport& report, Check check) {
  report.judged.push_back(check);
}

void skip(LintReport& report, Check check, const std::string& reason) {
  report.not_judged.push_back({check, reason});
}

double certainty_of(const Difference& difference, double harmless, double painful) {
  const double size = difference.size, places = static_cast<double>(difference.places);
  const double matters = std::clamp((size - harmless) / (painful - harmless), 0.0, 1.0);
  const double sure = size * size / (size * size + 16.0 * difference.error * difference.error);
  return matters > 0.0 ? matters * sure * places / (places + 10.0) : 0.0;
}

bool has_finding(const LintReport& report, Severity severity, double certainty) {
  return std::any_of(report.findings.begin(), report.findings.end(), [&](const Finding& finding) {
    return severity_of(finding.fault) <= severity && finding.certainty >= certainty;
  });
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

static bool is_small(const Subject& subject) {
  const Image& eye = subject.eyes[0];
  const double around = 2.0 * std::numbers::pi * pixels_per_radian(subject.projection(), eye.width);
  return around < kMinAround || eye.height < kMinHeight;
}

// Returns whether both eyes are large enough, and have no head-tilt map, for which parallax is not analysed.
static bool is_comparable(const Subject& subject) {
  return subject.eyes.size() == 2 && !is_small(subject) && !subject.format.camera.head_tilt_map;
}

static void check_pixels(const Subject& subject, LintReport& report) {
  check_seam(subject, report);
  check_horizon(subject, report);
  check_dead_poles(subject, report);
  check_codes(subject, report);
  if (!is_comparable(subject)) return;
  check_alignment(subject, report);
  check_colors(subject, report);
  check_sharpness(subject, report);
  check_parallax(subject, report);
  check_poles(subject, report);
  if (!subject.is_video) note_nearest(subject, report);
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
}

void sort_report(LintReport& report) {
  std::stable_sort(report.findings.begin(), report.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.certainty > b.certainty; });
  std::sort(report.judged.begin(), report.judged.end());
  std::stable_sort(report.not_judged.begin(), report.not_judged.end(),
                   [](const NotJudged& a, const NotJudged& b) { return a.check < b.check; });
}

LintReport lint_subject(Subject subject) {
  LintReport report;
  describe(subject, report);
  if (!is_small(subject)) make_views(subject);
  if (is_comparable(subject)) align(subject);
  std::string reason = "there is only one eye";
  if (subject.format.camera.head_tilt_map) reason = "its head-tilt map turns the parallax";
  const bool small = is_small(subject);
  if (small) reason = fmt::format("an eye of {}x{} pixels is too small", report.eye.width, report.eye.height);
  if (small || check_layout(subject, report)) {
    check_metadata(subject, report);
    check_shape(subject, report);
    check_black(subject, report);
    if (!small) check_pixels(subject, report);
  } else {
    reason = "the layout must be right first";
  }
  for (const Check check : kChecks) {
    if (is_of_time(check)) skip(report, check, "one picture has no time");
  }
  skip_the_rest(report, reason);
  sort_report(report);
  return report;
}

LintReport lint(const std::string& path, const LintOptions& options) {
  return lint_subject(load_subject(path, options));
}

}  // namespace ods
