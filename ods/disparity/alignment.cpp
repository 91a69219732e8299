// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/disparity/alignment.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "ods/base/angles.h"
#include "ods/base/median.h"

namespace ods {

namespace {

constexpr int kSectors = 16;
constexpr size_t kEnough = 10;      // matches
constexpr double kSure = 4.0;       // standard errors: a term is used if it is larger
constexpr double kPrecision = 0.1;  // pixels: of the median of many matches; parabola peaks are biased to whole pixels

// The terms of an alignment, then two for pairs of fixed cameras.
constexpr size_t kColumns = kAlignmentTerms + 2;
using Row = std::array<double, kColumns>;
using Columns = std::vector<size_t>;  // the columns that a fit uses
const Columns kAllTerms = {kRaiseTerm, kPitchTerm, kRollTerm, kZoomTerm}, kTwoCameras = {4, 5};

struct Sample {
  Row row{};          // derivatives of `down` by each term
  double down = 0.0;  // degrees
  double weight = 0.0;
};

struct Fit {
  Row value{};
  Row error{};
  double spread = 0.0;  // standard deviation of the residuals
};

Row row_of(const Match& match) {
  const double theta = static_cast<double>(match.theta), phi = static_cast<double>(match.phi);
  const double aside = std::sin(theta) * std::sin(phi) * std::cos(phi);
  return {1.0, -std::cos(theta), std::sin(theta), phi / kDegree, aside, aside * std::sin(phi)};
}

size_t sector_of(const Match& match) {
  const double turns = static_cast<double>(match.theta) / (2.0 * std::numbers::pi) + 0.5;
  return static_cast<size_t>(std::clamp(static_cast<int>(turns * kSectors), 0, kSectors - 1));
}

// Weights each heading, so that one full of detail counts little more than one with some detail.
std::vector<Sample> samples_of(const Matches& matches) {
  std::array<double, kSectors> count{};
  for (const Match& match : matches.found) count[sector_of(match)] += 1.0;
  std::vector<Sample> samples;
  for (const Match& match : matches.found) {
    const double weight = 1.0 / (count[sector_of(match)] + 4.0);
    samples.push_back({row_of(match), static_cast<double>(match.down) / kDegree, weight});
  }
  return samples;
}

// Solves a x = b for a symmetric positive a, and inverts a: Gauss-Jordan. Returns false if a is singular.
bool solve(std::vector<std::vector<double>>& a, size_t n) {
  for (size_t i = 0; i < n; i++) {
    const double pivot = a[i][i];
    if (!(pivot > 1e-12)) return false;
    for (double& value : a[i]) value /= pivot;
    for (size_t k = 0; k < n; k++) {
      const double factor = a[k][i];
      for (size_t j = 0; k != i && j < a[k].size(); j++) a[k][j] -= factor * a[i][j];
    }
  }
  return true;
}

double remainder_of(const Sample& sample, const Fit& fit) {
  double rest = sample.down;
  for (size_t c = 0; c < kColumns; c++) rest -= sample.row[c] * fit.value[c];
  return rest;
}

double spread_of(const std::vector<Sample>& samples, const Fit& fit, double minimum) {
  std::vector<double> sizes;
  for (const Sample& sample : samples) sizes.push_back(std::abs(remainder_of(sample, fit)));
  return std::max(1.4826 * median(std::move(sizes)), minimum);
}

// One step of reweighted least squares. Returns false if the matches do not determine the columns.
bool refit(const std::vector<Sample>& samples, const Columns& columns, Fit& fit) {
  const size_t n = columns.size();
  std::vector<std::vector<double>> a(n, std::vector<double>(2 * n + 1));
  double weights = 0.0, squares = 0.0;
  for (const Sample& sample : samples) {
    const double off = remainder_of(sample, fit) / (2.0 * fit.spread);
    const double weight = sample.weight / (1.0 + off * off);
    weights += weight, squares += weight * weight;
    for (size_t i = 0; i < n; i++) {
      for (size_t j = 0; j < n; j++) a[i][j] += weight * sample.row[columns[i]] * sample.row[columns[j]];
      a[i][2 * n] += weight * sample.row[columns[i]] * sample.down;
    }
  }
  for (size_t i = 0; i < n; i++) a[i][n + i] = 1.0;
  if (!solve(a, n)) return false;
  const double per_match = squares / weights;  // mean weight of a match
  fit.value = {};
  for (size_t i = 0; i < n; i++) {
    fit.value[columns[i]] = a[i][2 * n];
    fit.error[columns[i]] = fit.spread * std::sqrt(a[i][n + i] * per_match);
  }
  return true;
}

// Starts from a wide distribution, so that no mismatch decides, and narrows it down.
Fit fit_columns(const std::vector<Sample>& samples, const Columns& columns, double minimum) {
  Fit fit;
  fit.spread = std::max(spread_of(samples, fit, minimum), 1.0);
  for (int i = 0; i < 12 && !columns.empty(); i++) {
    if (!refit(samples, columns, fit)) return {};
    fit.spread = std::max(spread_of(samples, fit, minimum), i < 4 ? 0.5 * fit.spread : 0.0);
  }
  fit.spread = spread_of(samples, fit, minimum);
  return fit;
}

// The cost of the residuals, in which mismatches count little.
double cost_of(const std::vector<Sample>& samples, const Fit& fit, double spread) {
  double cost = 0.0;
  for (const Sample& sample : samples) {
    const double off = remainder_of(sample, fit) / (2.0 * spread);
    cost += sample.weight * std::log1p(off * off);
  }
  return cost;
}

// Adds the term that explains most, as long as it is significant.
Fit simplest_fit(const std::vector<Sample>& samples, Columns columns, double minimum) {
  Fit best = fit_columns(samples, columns, minimum);
  while (true) {
    std::optional<size_t> next;
    Fit better = best;
    double cost = cost_of(samples, best, best.spread);
    for (size_t term = 0; term < kColumns; term++) {
      if (std::find(columns.begin(), columns.end(), term) != columns.end()) continue;
      Columns more = columns;
      more.push_back(term);
      const Fit fit = fit_columns(samples, more, minimum);
      const double fit_cost = cost_of(samples, fit, best.spread);
      if (fit_cost >= cost || std::abs(fit.value[term]) < kSure * fit.error[term]) continue;
      next = term, better = fit, cost = fit_cost;
    }
    if (!next) return best;
    columns.push_back(*next), best = better;
  }
}

// The vertical search range in each scale: the full range in the coarsest view, then the remaining error.
constexpr float kReach[] = {0.24f, 0.06f, 0.02f};

Search search_at(size_t scale) {
  Search search;
  if (scale == 0) search.rows = 10, search.columns = 12, search.step = 8;
  search.down = kReach[std::min(scale, std::size(kReach) - 1)];
  search.lowest = -0.95f, search.highest = 0.95f;  // near the poles headings differ by large angles
  return search;
}

}  // namespace

EyeCorrection correction_of(const Alignment& alignment) {
  const auto value = [&](AlignmentTerm term) { return static_cast<float>(alignment.terms[term].value); };
  EyeCorrection correction;
  correction.raise = value(kRaiseTerm), correction.pitch = value(kPitchTerm), correction.roll = value(kRollTerm);
  correction.zoom = 1.0f + value(kZoomTerm);
  return correction;
}

GrayView corrected_view(const GrayView& view, const EyeCorrection& correction) {
  GrayView result(view.width, view.height, 1);
  const float width = static_cast<float>(view.width), height = static_cast<float>(view.height);
  const float pixel = 2.0f * std::numbers::pi_v<float> / width;
  tbb::parallel_for(0, view.height, [&](int y) {
    for (int x = 0; x < view.width; x++) {
      const float theta = pixel * (static_cast<float>(x) + 0.5f - 0.5f * width);
      const float phi = pixel * (0.5f * height - static_cast<float>(y) - 0.5f);
      const vec2 at = direction_to_lat_long(stored_direction(correction, look_at_angles(theta, phi).direction)) *
                          vec2(width, height) -
                      0.5f;
      const vec2 corner = floor(at), share = at - corner;
      const auto seen = [&](int dx, int dy) {
        const int column = (static_cast<int>(corner.x) + dx + view.width) % view.width;
        return *view.at(column, std::clamp(static_cast<int>(corner.y) + dy, 0, view.height - 1));
      };
      *result.at(x, y) = (1.0f - share.y) * ((1.0f - share.x) * seen(0, 0) + share.x * seen(1, 0)) +
                         share.y * ((1.0f - share.x) * seen(0, 1) + share.x * seen(1, 1));
    }
  });
  return result;
}

Alignment find_alignment(const std::vector<std::vector<GrayView>>& scales, bool two_cameras) {
  Alignment alignment;
  for (size_t scale = 0; scale < scales.size(); scale++) {
    const GrayView& left = scales[scale][0];
    const EyeCorrection so_far = correction_of(alignment);
    const GrayView right = moves_pixels(so_far) ? corrected_view(scales[scale][1], so_far) : scales[scale][1];
    const Matches matches = match_tiles(left, right, search_at(scale));
    alignment.matches = static_cast<int>(matches.found.size());
    alignment.headings = 0.0;
    if (matches.found.size() < kEnough || matches.share() < 0.1) return alignment;
    const std::vector<Sample> samples = samples_of(matches);
    const double minimum = kPrecision * static_cast<double>(matches.pixel) / kDegree;
    const Columns always = two_cameras ? kTwoCameras : Columns();
    const Fit fit = simplest_fit(samples, always, minimum), whole = fit_columns(samples, kAllTerms, minimum);
    for (size_t term = 0; term < kAlignmentTerms; term++) {
      alignment.terms[term].value += fit.value[term];
      alignment.terms[term].error = fit.error[term] > 0.0 ? fit.error[term] : whole.error[term];
    }
    std::array<double, kSectors> count{};
    for (const Match& match : matches.found) count[sector_of(match)] += 1.0;
    for (const double each : count) alignment.headings += each / (each + 1.0);
    alignment.unexplained = fit.spread / 1.4826;
  }
  return alignment;
}

}  // namespace ods
