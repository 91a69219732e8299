// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods lint: finds faults in a stereo 360 picture.
#include "ods/lint/lint.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cli/console/console.h"
#include "cli/console/interrupt.h"
#include "cli/options/picture_options.h"
#include "cli/options/projection_options.h"

using ods::Finding, ods::LintReport, ods::Severity;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char* kExamples =
    "  ods lint picture.png\n"
    "  ods lint eye_%V.exr --json\n"
    "  ods lint video_frame.jpg --layout side-by-side --projection vr180 || echo do not ship it";

constexpr const char* kSummary =
    "Finds faults in a stereo 360 picture: swapped eyes, one eye twice, a wrong layout, a mirrored viewing circle,\n"
    "two fixed cameras, a visible seam, no pole merge, a wrong shape, metadata that contradicts the pixels. Each\n"
    "finding has a certainty (0 to 1), the evidence and a cure; what was judged and what was not is listed.\n"
    "docs/lint.md explains them. Exit code 1: a fault was found; warnings and information do not count.";

struct LintJob {
  std::string path;
  ods::LintOptions lint;
  ods::ProjectionSetting projection;
  float min_certainty = 0.5f;
  bool json = false;
};

bool read_options(LintJob& job, int argc, char** argv) {
  Options options("lint", kSummary, kExamples);
  options.argument("PICTURE", job.path, "a picture; %V in the name: one file per eye");
  add_layout_option(options, job.lint.layout,
                    "layout, if neither the file nor its name (_TB, _LR, ...) tells; separate: one eye");
  options.number("--min-certainty", job.min_certainty, 0.0f, 1.0f, "hide findings below this certainty");
  add_projection_options(options, job.projection);
  options.group("Console");
  options.flag("--json", job.json, "print JSON");
  add_console_options(options);
  if (!options.parse(argc, argv)) return false;
  const std::string fault = ods::projection_fault(job.projection);
  if (!fault.empty()) throw UsageError(fault);
  if (options.given("--projection") || options.given("--face") || options.given("--range")) {
    job.lint.projection = job.projection;
  }
  return true;
}

std::string layout_word(const LintReport& report) {
  return std::string(report.layout ? ods::layout_name(*report.layout) : report.eye_count > 1 ? "separate" : "one eye");
}

std::vector<std::string_view> check_names(const std::vector<ods::Check>& checks) {
  std::vector<std::string_view> names;
  for (const ods::Check check : checks) names.push_back(check_name(check));
  return names;
}

bool is_told(const LintJob& job, const Finding& finding) {
  return finding.certainty >= static_cast<double>(job.min_certainty);
}

void print_text(const LintJob& job, const LintReport& report) {
  fmt::print("{}: {}x{}, {} ({}), {}, an eye {}x{}\n", job.path, report.file.width, report.file.height,
             layout_word(report), report.reason, report.projection, report.eye.width, report.eye.height);
  int faults = 0;
  for (const Finding& finding : report.findings) {
    if (!is_told(job, finding)) continue;
    const Severity severity = severity_of(finding.fault);
    if (severity == Severity::kFault) faults++;
    fmt::print("{} {}: {}, certainty {:.2f}: {}. Cure: {}.\n", severity_name(severity), fault_name(finding.fault),
               fault_title(finding.fault), finding.certainty, finding.evidence, finding.cure);
  }
  for (const std::string& text : report.notes) fmt::print("note: {}\n", text);
  fmt::print("judged: {}\n", fmt::join(check_names(report.judged), ", "));
  for (const ods::NotJudged& each : report.not_judged) {
    fmt::print("not judged: {} ({})\n", check_name(each.check), each.reason);
  }
  fmt::print("{} found in what was judged\n",
             faults == 0 ? "no fault" : fmt::format("{} fault{}", faults, faults == 1 ? "" : "s"));
}

void print_json(const LintJob& job, const LintReport& report) {
  Json json = {{"path", job.path},
               {"file", {report.file.width, report.file.height}},
               {"eye", {report.eye.width, report.eye.height}},
               {"eyes", report.eye_count},
               {"layout", layout_word(report)},
               {"reason", report.reason},
               {"projection", report.projection},
               {"findings", Json::array()},
               {"judged", check_names(report.judged)},
               {"not_judged", Json::array()},
               {"notes", report.notes}};
  for (const ods::NotJudged& each : report.not_judged) {
    json["not_judged"].push_back({{"check", check_name(each.check)}, {"reason", each.reason}});
  }
  for (const Finding& finding : report.findings) {
    if (!is_told(job, finding)) continue;
    json["findings"].push_back({{"fault", fault_name(finding.fault)},
                                {"severity", severity_name(severity_of(finding.fault))},
                                {"title", fault_title(finding.fault)},
                                {"certainty", finding.certainty},
                                {"evidence", finding.evidence},
                                {"cure", finding.cure}});
  }
  // File names need not be valid UTF-8.
  std::puts(json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

void run(int argc, char** argv) {
  LintJob job;
  if (!read_options(job, argc, argv)) return;
  end_on_interrupts();
  const LintReport report = ods::lint(job.path, job.lint);
  job.json ? print_json(job, report) : print_text(job, report);
  if (has_finding(report, Severity::kFault, static_cast<double>(job.min_certainty))) {
    throw std::runtime_error("a fault was found");
  }
}

}  // namespace

int ods_lint(int argc, char** argv) {
  return run_command([=] { run(argc, argv); });
}
