// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a whole turn closes. A step from one column to the next counts by how much it exceeds the steps on either side
// of it, so that neither slopes nor soft edges count; the step at the seam is compared with all others.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ods/image/tone.h"
#include "ods/lint/checks.h"

namespace ods {

namespace {

constexpr int kBlocks = 32;  // of rows
constexpr size_t kWide = 2;  // columns that are averaged on either side, against noise

using Columns = std::vector<double>;

// The mean of some rows, for each column around the picture, as a display shows them.
Columns mean_row(const Image& eye, int from, int to) {
  Columns mean(static_cast<size_t>(eye.width));
  for (int y = from; y < to; y++) {
    for (int x = 0; x < eye.width; x++) {
      const float light = *eye.at(x, y);
      const float shown = std::isnan(light) ? 0.0f : srgb_encode(std::clamp(light, 0.0f, 1.0f));
      mean[static_cast<size_t>(x)] += static_cast<double>(shown) / (to - from);
    }
  }
  return mean;
}

// For each column, the step from it to the next columns, minus half the sum of the steps before and after.
Columns breaks_of(const Columns& row) {
  const size_t n = row.size();
  Columns mean(n), breaks(n);
  for (size_t x = 0; x < n; x++) {
    for (size_t i = 0; i < kWide; i++) mean[x] += row[(x + i) % n] / static_cast<double>(kWide);
  }
  for (size_t x = 0; x < n; x++) {
    const auto at = [&](size_t forward, size_t back) { return mean[(x + 1 + forward + n - back) % n]; };
    const double before = at(0, 2 * kWide), here = at(0, kWide), next = at(0, 0), after = at(kWide, 0);
    breaks[x] = std::abs((next - here) - 0.5 * ((here - before) + (after - next)));
  }
  return breaks;
}

// The rank of each value among all, 0..1.
Columns ranks_of(const Columns& values) {
  Columns sorted = values;
  std::sort(sorted.begin(), sorted.end());
  Columns ranks;
  for (double value : values) {
    const auto [low, high] = std::equal_range(sorted.begin(), sorted.end(), value);
    ranks.push_back(0.5 * static_cast<double>((low - sorted.begin()) + (high - sorted.begin())) /
                    static_cast<double>(sorted.size()));
  }
  return ranks;
}

// The rank of each column's break among all columns, 0..1. Rows of all heights have equal weight, and so have both
// eyes: a vertical edge of the scene is sharp in some rows, and at another column in each eye; a broken seam is sharp
// in all.
Columns measure(const std::vector<Image>& eyes) {
  Columns score(static_cast<size_t>(eyes[0].width));
  for (const Image& eye : eyes) {
    for (int i = 0; i < kBlocks; i++) {
      const Columns row = mean_row(eye, eye.height * i / kBlocks, eye.height * (i + 1) / kBlocks);
      const Columns ranks = ranks_of(breaks_of(row));
      for (size_t x = 0; x < score.size(); x++) score[x] += ranks[x] / (kBlocks * static_cast<double>(eyes.size()));
    }
  }
  return score;
}

void check_break(const std::vector<Image>& eyes, LintReport& report) {
  const Columns score = measure(eyes);
  const double seam = score.back();
  const double most = *std::max_element(score.begin() + 2 * kWide, score.end() - 1 - 2 * kWide);
  const double certainty = std::clamp(0.3 + 10.0 * (seam - most), 0.0, 1.0) * std::clamp(5.0 * (seam - 0.5), 0.0, 1.0);
  if (certainty < 0.1) return;
  report.findings.push_back(
      {Fault::kRaggedSeam, certainty,
       fmt::format("from the last column to the first, rows break more sharply than at {:.0f} % of all columns, at the "
                   "worst of the others than at {:.0f} %",
                   100.0 * seam, 100.0 * most),
       "make it cover exactly 360 degrees, in one light and level: nothing cropped, doubled or blended there"});
}

// Edges at 0 and at 360 degrees are the same direction; if both are rendered, every turn of the head shows it twice.
void check_doubled(const std::vector<Image>& eyes, LintReport& report) {
  std::vector<double> steps(static_cast<size_t>(eyes[0].width));
  for (int i = 0; i < kBlocks; i++) {
    const Columns row = mean_row(eyes[0], eyes[0].height * i / kBlocks, eyes[0].height * (i + 1) / kBlocks);
    for (size_t x = 0; x < row.size(); x++) steps[x] += std::abs(row[(x + 1) % row.size()] - row[x]) / kBlocks;
  }
  const double seam = steps.back(), least = *std::min_element(steps.begin(), steps.end() - 1);
  const double certainty = least > 5e-4 ? 1.0 - 4.0 * seam / least : 0.0;
  if (certainty < 0.1) return;
  report.findings.push_back(
      {Fault::kRaggedSeam, certainty,
       fmt::format("the last column repeats the first: they differ by {:.2g}, all neighbours by at least {:.2g}", seam,
                   least),
       "leave out the last column, and render the directions of the pixels' middles"});
}

}  // namespace

void check_seam(const Subject& subject, LintReport& report) {
  const bool closes = has_range(subject.projection().kind) &&
                      subject.projection().longitude.y - subject.projection().longitude.x > 359.9f;
  if (!closes) {
    skip(report, Check::kSeam, "this projection has none");
    return;
  }
  judge(report, Check::kSeam);
  check_break(subject.eyes, report);
  check_doubled(subject.eyes, report);
}

}  // namespace ods
