// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Checks height, pitch, roll and size of one eye against the other, as measured by ods/disparity/alignment.h.
#include "ods/disparity/alignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ods/lint/checks.h"

namespace ods {

namespace {

// A term below `harmless` is not noticed; above `painful`, every viewer notices it. Eyes fuse differences in height of
// up to 19 to 26 minutes of arc, depending on the source; a roll or a magnification has its full effect at the sides
// only.
struct TermRow {
  AlignmentTerm term;
  Fault fault;
  double harmless;
  double painful;
  const char* option;
};
constexpr TermRow kTerms[] = {
    {kRaiseTerm, Fault::kVerticalOffset, 0.2, 0.45, "`right-raise`"},
    {kPitchTerm, Fault::kEyePitched, 0.2, 0.45, "`right-pitch`"},
    {kRollTerm, Fault::kEyeRolled, 0.3, 0.7, "`right-roll`"},
    {kZoomTerm, Fault::kEyeMagnified, 0.006, 0.014, "`right-zoom`"},
};
constexpr double kUnsure = 0.05;  // degrees: with a larger standard error of a height, lint does not judge
constexpr double kEnoughHeadings = 1.0;

double certainty_of(const TermRow& row, const Alignment& alignment) {
  const Alignment::Term& term = alignment.terms[row.term];
  return ods::certainty_of({std::abs(term.value), term.error, static_cast<size_t>(alignment.matches)}, row.harmless,
                           row.painful);
}

// Empty if the terms are known.
std::string why_unknown(const Alignment& alignment) {
  if (alignment.headings < kEnoughHeadings) return "not enough detail that both eyes show";
  const bool sure = alignment.unexplained < kUnsure * std::sqrt(static_cast<double>(alignment.matches));
  return sure ? "" : "the places that both eyes show do not agree well enough";
}

std::string evidence_of(const TermRow& row, const Alignment& alignment) {
  const Alignment::Term& term = alignment.terms[row.term];
  const double size = std::abs(term.value);
  const bool more = term.value > 0.0;
  const std::string places = fmt::format("by {} places that both eyes show", alignment.matches);
  switch (row.term) {
    case kRaiseTerm:
      return fmt::format("the right eye's picture is {:.2f} degrees {} than the left one's, all around, +-{:.2f} {}",
                         size, more ? "lower" : "higher", term.error, places);
    case kPitchTerm:
      return fmt::format(
          "the right eye's picture is {:.2f} degrees {} than the left one's ahead and as much {} "
          "behind, +-{:.2f} {}",
          size, more ? "higher" : "lower", more ? "lower" : "higher", term.error, places);
    case kRollTerm:
      return fmt::format("the right eye's picture is rolled by {:.2f} degrees {} against the left one's, +-{:.2f} {}",
                         size, more ? "clockwise" : "anticlockwise", term.error, places);
    default:
      return fmt::format("the right eye's picture is {:.2f} % {} than the left one's, +-{:.2f} {}", 100.0 * size,
                         more ? "smaller" : "larger", 100.0 * term.error, places);
  }
}

// The command that corrects all terms.
std::string remedy_of(const Subject& subject) {
  std::string options;
  for (const TermRow& row : kTerms) {
    if (certainty_of(row, subject.alignment) < 0.1) continue;
    const double value = subject.alignment.terms[row.term].value;
    if (!options.empty()) options += " ";
    options += row.term == kZoomTerm ? fmt::format("{} {:.4f}", row.option, 1.0 + value)
                                     : fmt::format("{} {:.2f}", row.option, value);
  }
  return "align the cameras, or correct the picture: " + convert_command(subject, options);
}

}  // namespace

EyeCorrection significant_correction(const Alignment& alignment) {
  if (!why_unknown(alignment).empty()) return {};
  const bool matters = std::any_of(std::begin(kTerms), std::end(kTerms),
                                   [&](const TermRow& row) { return certainty_of(row, alignment) > 0.0; });
  return matters ? correction_of(alignment) : EyeCorrection();
}

void check_alignment(const Subject& subject, LintReport& report) {
  const Alignment& alignment = subject.alignment;
  if (const std::string why = why_unknown(alignment); !why.empty()) return skip(report, Check::kAlignment, why);
  judge(report, Check::kAlignment);
  for (const TermRow& row : kTerms) {
    const double certainty = certainty_of(row, alignment);
    if (certainty < 0.1) continue;
    report.findings.push_back({row.fault, certainty, evidence_of(row, alignment), remedy_of(subject)});
  }
}

}  // namespace ods
