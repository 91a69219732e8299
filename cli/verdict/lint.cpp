// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods lint: finds faults in a stereo 360 picture.
#include "ods/lint/lint.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/picture_options.h"
#include "cli/options/projection_options.h"
#include "cli/verdict/lint_report.h"
#include "ods/camera/file_names.h"
#include "ods/lint/video.h"
#include "ods/video/container/video_file.h"

namespace {

constexpr const char* kLintExamples =
    "  ods lint picture.png\n"
    "  ods lint eye_%V.exr --json\n"
    "  ods lint film_360_TB.mp4\n"
    "  ods lint video_frame.jpg --layout side-by-side --projection vr180 || echo do not ship it";

constexpr const char* kLintSummary =
    "Finds faults in a stereo 360 picture or video: swapped eyes, one eye twice, a wrong layout, a mirrored viewing\n"
    "circle, two fixed cameras, an eye that is higher, rolled, tinted, darker or blurred against the other, a visible\n"
    "seam, no pole merge, a tilted horizon, clipped highlights, a wrong shape, metadata that contradicts the pixels; "
    "in\n"
    "videos also eyes that are apart in time, cuts of one eye, duplicate frames. Each finding has a certainty (0 to "
    "1),\n"
    "the evidence and a remedy; what was judged and what was not is listed. docs/lint.md explains them. Exit code 5: a\n"
    "fault was found; warnings and information do not count.";

struct LintJob {
  std::vector<std::string> files;
  std::string path;  // of joined_input()
  ods::LintOptions lint;
  float min_certainty = 0.5f;
  int every = 0;
  ProgressMode progress = ProgressMode::kAuto;
  bool json = false;
};

LintJob parse_lint(Options& options) {
  LintJob job;
  options.describe(kLintSummary, kLintExamples);
  add_input_argument(options, ValueKind::input_file("FILE"), job.files, "a picture or a video");
  add_input_layout_option(options, job.lint.layout, "layout, if it is not detected");
  options.number("--min-certainty", job.min_certainty, 0.0f, 1.0f, "hide findings below this certainty");
  ods::FormatHint lenses;
  add_lens_options(options, lenses);
  ProjectionChanges projection;
  add_projection_options(options, projection);
  options.group("Videos");
  options.number("--every", job.every, 0, 1 << 30,
                 "judge every N-th frame as a picture; 1: all; 0: about 24, and one of every shot");
  options.group("Console");
  options.flag("--json", job.json, "print JSON");
  add_progress_options(options, job.progress);
  options.parse();
  const ods::ProjectionSetting requested = changed({}, projection);
  const std::string fault = ods::projection_fault(requested);
  if (!fault.empty()) throw UsageError(fault);
  if (projection.named || projection.face || projection.range) job.lint.projection = requested;
  if (lenses.front_and_back) throw UsageError("--front-and-back is one eye, and lint judges two: convert it");
  lenses.projection = job.lint.projection;
  finish_lens_options(lenses);
  job.lint.lenses = lenses.lenses;
  return job;
}

ods::LintReport lint_with_progress(const LintJob& job, ProgressLines& lines) {
  const auto start = std::chrono::steady_clock::now();
  ods::Progress progress;
  progress.report = [&](double done) { lines.report(done, seconds_since(start), {"lint", 0, 0, job.path}); };
  return ods::lint_video(job.path, {job.lint, job.every}, progress);
}

ExitCode run_lint(LintJob job) {
  ods::FormatHint known;
  known.layout = job.lint.layout, known.projection = job.lint.projection, known.lenses = job.lint.lenses;
  job.path = joined_input(job.files, known);
  const bool is_film = !ods::names_files(job.path) && std::filesystem::exists(job.path) && ods::is_video(job.path);
  if (!is_film && job.every > 0) throw UsageError(fmt::format("--every is for videos, and '{}' is not one", job.path));
  ods::LintReport report;
  run_long_job(job.progress, 0, [&](ProgressLines& lines) {
    report = is_film ? lint_with_progress(job, lines) : ods::lint(job.path, job.lint);
  });
  for (ods::Finding& finding : report.findings) {
    finding.evidence = with_options(finding.evidence), finding.remedy = with_options(finding.remedy);
  }
  for (std::string& text : report.notes) text = with_options(text);
  std::erase_if(report.findings, [&](const ods::Finding& finding) {
    return finding.certainty < static_cast<double>(job.min_certainty);
  });
  job.json ? print_json(job.path, report) : print_text(job.path, report);
  return has_finding(report, ods::Severity::kFault, 0.0) ? kExitFault : kExitOk;
}

}  // namespace

extern const Command kLint = make_command<parse_lint, run_lint>("lint", "find faults in a stereo 360 picture");
