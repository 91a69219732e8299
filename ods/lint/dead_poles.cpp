// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds a pole without a picture: a disc of one value, with an edge at the same elevation all around, as left by rigs
// that see neither straight up nor straight down. A clear sky has no such edge.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ods/lint/checks.h"

namespace ods {

namespace {

constexpr float kSame = 0.012f;     // as displayed: three steps of 8 bits
constexpr int kBlock = 8;           // rows
constexpr double kAllAround = 0.9;  // minimum visible fraction of the edge
constexpr double kSmallest = 3.0;   // minimum radius, degrees
constexpr double kLargest = 60.0;

// The number of rows from a pole that have one value.
int dead_rows(const GrayView& view, bool top) {
  const float value = *view.at(0, top ? 0 : view.height - 1);
  int rows = 0;
  for (; rows < view.height; rows++) {
    const float* row = view.at(0, top ? rows : view.height - 1 - rows);
    if (!std::all_of(row, row + view.width, [&](float each) { return std::abs(each - value) < kSame; })) break;
  }
  return rows;
}

// Fraction of the ring beyond the disc, outside JPEG's ringing, that differs from the disc.
double share_of_edge(const GrayView& view, bool top, int rows) {
  const float value = *view.at(0, top ? 0 : view.height - 1);
  const int beyond = rows + kBlock;
  if (beyond >= view.height) return 0.0;
  const float* row = view.at(0, top ? beyond : view.height - 1 - beyond);
  const auto count =
      std::count_if(row, row + view.width, [&](float each) { return std::abs(each - value) > 2 * kSame; });
  return static_cast<double>(count) / view.width;
}

}  // namespace

void check_dead_poles(const Subject& subject, LintReport& report) {
  const GrayView& view = subject.scales.back()[0];
  const auto reaches = [&](int y) { return !std::isnan(*view.at(view.width / 2, y)) && !std::isnan(*view.at(0, y)); };
  if (!reaches(0) && !reaches(view.height - 1)) {
    return skip(report, Check::kDeadPoles, "the picture does not reach the poles");
  }
  judge(report, Check::kDeadPoles);
  for (const bool top : {true, false}) {
    const int rows = dead_rows(view, top);
    const double radius = 360.0 * rows / view.width, edge = share_of_edge(view, top, rows);
    if (radius < kSmallest || radius > kLargest || edge < kAllAround) continue;
    const float value = *view.at(0, top ? 0 : view.height - 1);
    report.findings.push_back(
        {Fault::kDeadPole, std::min(1.0, edge) * std::min(1.0, radius / (2.0 * kSmallest) + 0.25),
         fmt::format("a disc of {:.1f} degrees radius at the {} has one value ({:.0f} of 255), and its edge shows at "
                     "{:.0f} % of all headings",
                     radius, top ? "top" : "bottom", static_cast<double>(255.0f * value), 100.0 * edge),
         "fill it from a picture that looks there (ods over), or put a title over it (ods title)"});
  }
}

}  // namespace ods
