// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/verdict/lint_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/console/print.h"
#include "ods/base/json_reader.h"

using ods::Finding, ods::LintReport, ods::Severity;
using ods::Json;

namespace {

std::string layout_token(const LintReport& report) {
  return std::string(report.layout ? ods::layout_name(*report.layout) : report.eye_count > 1 ? "separate" : "one eye");
}

std::vector<std::string_view> check_names(const std::vector<ods::Check>& checks) {
  std::vector<std::string_view> names;
  for (const ods::Check check : checks) names.push_back(check_name(check));
  return names;
}

// Their names by reason, in the order of the first of each.
std::vector<std::pair<std::string, std::vector<std::string_view>>> by_reason(const std::vector<ods::NotJudged>& all) {
  std::vector<std::pair<std::string, std::vector<std::string_view>>> groups;
  for (const ods::NotJudged& each : all) {
    const auto same = [&](const auto& group) { return group.first == each.reason; };
    auto group = std::find_if(groups.begin(), groups.end(), same);
    if (group == groups.end()) group = groups.insert(groups.end(), {each.reason, {}});
    group->second.push_back(check_name(each.check));
  }
  return groups;
}

// "3.20 s", "0.00 to 7.50 s".
std::string times_text(const std::vector<double>& times) {
  if (times.size() == 1) return fmt::format("at {:.2f} s", times[0]);
  return fmt::format("from {:.2f} to {:.2f} s", times.front(), times.back());
}

void print_finding(const Finding& finding) {
  const std::string when = finding.times.empty() ? "" : ", " + times_text(finding.times);
  put_out(fmt::format("{} {}: {}, certainty {:.2f}{}: {}. Remedy: {}.\n", severity_name(severity_of(finding.fault)),
                      fault_name(finding.fault), fault_title(finding.fault), finding.certainty, when, finding.evidence,
                      finding.remedy));
}

}  // namespace

void print_text(const std::string& path, const LintReport& report) {
  put_out(fmt::format("{}: {}x{}, {} ({}), {}, an eye {}x{}\n", path, report.file.width, report.file.height,
                      layout_token(report), report.reason, report.projection, report.eye.width, report.eye.height));
  if (report.frames > 0)
    put_out(fmt::format("{} frames, of which {} were judged\n", report.frames, report.judged_frames));
  for (const Finding& finding : report.findings) print_finding(finding);
  for (const std::string& text : report.notes) put_out(fmt::format("note: {}\n", text));
  put_out(fmt::format("judged: {}\n", fmt::join(check_names(report.judged), ", ")));
  for (const auto& [reason, names] : by_reason(report.not_judged)) {
    put_out(fmt::format("not judged: {} ({})\n", fmt::join(names, ", "), reason));
  }
  const auto faults = std::count_if(report.findings.begin(), report.findings.end(), [](const Finding& finding) {
    return severity_of(finding.fault) == Severity::kFault;
  });
  put_out(fmt::format("{} found in what was judged\n",
                      faults == 0 ? "no fault" : fmt::format("{} fault{}", faults, faults == 1 ? "" : "s")));
}

void print_json(const std::string& path, const LintReport& report) {
  Json json = {{"path", path},
               {"file", {report.file.width, report.file.height}},
               {"eye", {report.eye.width, report.eye.height}},
               {"eyes", report.eye_count},
               {"layout", layout_token(report)},
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
    json["findings"].push_back({{"fault", fault_name(finding.fault)},
                                {"severity", severity_name(severity_of(finding.fault))},
                                {"title", fault_title(finding.fault)},
                                {"certainty", finding.certainty},
                                {"evidence", finding.evidence},
                                {"remedy", finding.remedy}});
    if (!finding.times.empty()) json["findings"].back()["times"] = finding.times;
  }
  if (report.frames > 0) json["frames"] = report.frames, json["judged_frames"] = report.judged_frames;
  // File names need not be valid UTF-8.
  put_json(json);
}
