// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Shared by the two benchmarks of ods lint: faults to plant, into pictures or films, and their findings in the report.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "ods/lint/lint.h"

template <class Subject>
struct Plant {
  std::string name;
  std::vector<ods::Fault> faults;  // any of them is correct; empty if the subject is correct
  ods::Check check;                // the check that finds it
  std::string unit;
  std::vector<double> strengths;
  std::function<void(Subject& subject, double strength)> plant = {};

  bool explains(const ods::Finding& finding) const {
    return std::find(faults.begin(), faults.end(), finding.fault) != faults.end();
  }
};

struct Verdict {
  bool found = false;
  bool judged = true;  // the check was made
  int others = 0;      // faults that were not planted
  std::string text;

  bool is_expected(bool is_correct) const { return others == 0 && (found || is_correct); }
};

// Warnings that were not planted do not count, except for duplicate frames.
inline Verdict verdict_of(const ods::LintReport& report, ods::Check check,
                          const std::function<bool(const ods::Finding& finding)>& is_planted) {
  Verdict verdict;
  for (const ods::Finding& finding : report.findings) {
    const bool planted = is_planted(finding);
    const bool counts =
        severity_of(finding.fault) == ods::Severity::kFault || finding.fault == ods::Fault::kDuplicateFrames;
    if (finding.certainty < 0.5 || (!planted && !counts)) continue;
    verdict.found = verdict.found || planted;
    verdict.others += planted ? 0 : 1;
    verdict.text += fmt::format(" {} {:.2f}: {};", fault_name(finding.fault), finding.certainty, finding.evidence);
  }
  for (const ods::NotJudged& skipped : report.not_judged) {
    if (skipped.check == check) verdict.judged = false;
  }
  return verdict;
}
