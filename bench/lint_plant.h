// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What the two benchmarks of ods lint share: faults to plant, into pictures or films, and what the report says of them.
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
  std::vector<ods::Fault> faults;  // any of them is right; empty: the subject is correct
  ods::Check check;                // which finds it
  std::string unit;
  std::vector<double> strengths;
  std::function<void(Subject& subject, double strength)> plant = {};

  bool explains(const ods::Finding& finding) const {
    return std::find(faults.begin(), faults.end(), finding.fault) != faults.end();
  }
};

struct Verdict {
  bool found = false;
  bool judged = true;  // the check that would have found it was made
  int others = 0;      // faults that were not planted
  std::string text;

  bool is_expected(bool is_correct) const { return others == 0 && (found || is_correct); }
};

// Warnings that were not planted do not count, but for frames that are there twice.
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
