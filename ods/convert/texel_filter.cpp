// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/texel_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "ods/base/wide.h"

namespace ods {

// --- tents ----------------------------------------------------------------------------------------------------------

// Below this radius the picture is only interpolated: a blur by a hundredth of half a texel would cost sharpness
// without a benefit.
static const float kMinRadius = 0.15f;
static const int kMaxPoints = 65;  // along one axis

namespace {

// Points at equal steps. Their weights add up to 1, and rise and fall by equal steps.
struct Tent {
  int count = 1;
  float offset = 0.0f;  // offset of the first point
  float step = 0.0f;
  float first_weight = 1.0f;

  float at(int i) const { return offset + step * static_cast<float>(i); }
  float weight(int i) const { return first_weight * static_cast<float>(std::min(2 * i + 1, 2 * (count - i) - 1)); }
};

}  // namespace

// Points that have the tent's variance, radius^2 / 6. The points of a tent of radius 1 have a slightly larger variance,
// `variance` / 6, which follows from the sums of 1, 3, 5, ... and of their squares and cubes.
static Tent make_tent(float variance_of_6) {
  Tent tent;
  if (variance_of_6 < kMinRadius * kMinRadius) return tent;
  tent.count = std::min(1 + static_cast<int>(std::ceil(2.0f * std::sqrt(variance_of_6))), kMaxPoints);
  const bool even = tent.count % 2 == 0;
  const float n = static_cast<float>(tent.count), nn = n * n;
  const float variance = even ? 1.0f + 2.0f / nn : (nn - 1.0f) * (nn + 3.0f) / (nn * (nn + 1.0f));
  const float radius = std::sqrt(variance_of_6 / variance);
  tent.first_weight = 2.0f / (even ? nn : nn + 1.0f);
  tent.step = 2.0f * radius / n;
  tent.offset = 0.5f * tent.step - radius;
  return tent;
}

void filter_points(const Footprint& footprint, std::vector<FilterPoint>& points) {
  const vec2 dx = footprint.dx, dy = footprint.dy;
  // The axes of the ellipse onto which a round pixel is mapped: eigenvectors of J J^T, with the eigenvalues s^2.
  const float xx = dx.x * dx.x + dy.x * dy.x, yy = dx.y * dx.y + dy.y * dy.y, xy = dx.x * dx.y + dy.x * dy.y;
  points.assign(1, {vec2(0.0f), vec2(0.0f), 1.0f});
  if (xx + yy <= 1.0f) return;
  const float middle = 0.5f * (xx + yy), half = std::sqrt(0.25f * (xx - yy) * (xx - yy) + xy * xy);
  const float large = middle + half, small = middle - half;
  const Tent along = make_tent(large - 1.0f), across = make_tent(small - 1.0f);
  if (along.count == 1 || !std::isfinite(large)) return;
  vec2 axis = xx >= yy ? vec2(large - yy, xy) : vec2(xy, large - xx);
  axis = length(axis) > 0.0f ? normalize(axis) : vec2(1.0f, 0.0f);
  const vec2 other(-axis.y, axis.x);
  const auto back = [&](vec2 v, float square) { return vec2(dot(dx, v), dot(dy, v)) / square; };
  const vec2 pixels_along = back(axis, large), pixels_across = small > 0.5f ? back(other, small) : vec2(0.0f);
  points.clear();
  for (int j = 0; j < across.count; j++) {
    for (int i = 0; i < along.count; i++) {
      const float t = along.at(i), u = across.at(j);
      points.push_back(
          {axis * t + other * u, pixels_along * t + pixels_across * u, along.weight(i) * across.weight(j)});
    }
  }
}

// --- columns and rows -----------------------------------------------------------------------------------------------

// A SIMD register, which compilers do not use automatically here. Both g++ and clang support this attribute.
using Four = float __attribute__((vector_size(16)));

// Catmull-Rom weights of the texels at -1, 0, 1 and 2.
static Four cubic_weights(float t) {
  const Four once{-0.5f, 0.0f, 0.5f, 0.0f}, squared{1.0f, -2.5f, 2.0f, -0.5f}, cubed{-0.5f, 1.5f, -1.5f, 0.5f};
  const Four middle{0.0f, 1.0f, 0.0f, 0.0f};
  return middle + t * (once + t * (squared + t * cubed));
}

namespace {

struct Position {
  int texel;
  float beyond;  // distance beyond the texel's centre
};

}  // namespace

static Position split_exactly(float at) {
  const float from = at - 0.5f;
  const int towards_0 = static_cast<int>(from), whole = towards_0 - (static_cast<float>(towards_0) > from ? 1 : 0);
  return {whole, from - static_cast<float>(whole)};
}

// A position this close to the centre of a texel is treated as exactly there, because the round trip through angles has
// that much error.
static Position split(float at) {
  const float kTolerance = 1.0f / 256.0f;
  const Position exact = split_exactly(at);
  const bool is_next = exact.beyond > 1.0f - kTolerance;
  return {exact.texel + (is_next ? 1 : 0), exact.beyond < kTolerance || is_next ? 0.0f : exact.beyond};
}

static void sum_weights(float at, const Tent& tent, TexelWeights& to) {
  Position position = split(at + tent.at(0));
  to.first = position.texel - 1;
  to.count = 0;
  Four sums{};  // sums of the four weights from to.count on, which later points still change
  for (int i = 0, texel = position.texel; i < tent.count; i++) {
    position = split(at + tent.at(i));
    for (; texel < position.texel; texel++) {
      to.weights[to.count++] = sums[0];
      sums = Four{sums[1], sums[2], sums[3], 0.0f};
    }
    sums += cubic_weights(position.beyond) * tent.weight(i);
  }
  std::memcpy(to.weights + to.count, &sums, sizeof sums);
  to.count += 4;
}

namespace {

// The weights of tents, which are slow to sum, in a table over the squared radius and the position between two texels.
struct TentTable {
  static constexpr int kSteps = 48;  // per unit of the squared radius, the filter's added variance times 6
  static constexpr int kSquares = 9 * kSteps;
  static constexpr int kPhases = 128;  // per texel
  static constexpr int kMax = 12;      // weights
  struct Row {
    int first = kMax;  // texel of the first weight, relative to the one before the position
    int count = 0;
    std::array<std::array<float, kMax>, kPhases + 2> weights;  // the last one twice, so that it has a successor
  };
  std::vector<Row> rows{kSquares};

  TentTable();
};

}  // namespace

TentTable::TentTable() {
  for (size_t i = 0; i < rows.size(); i++) {
    const Tent tent = make_tent(static_cast<float>(i) / kSteps);
    std::array<TexelWeights, kPhases + 1> phases;
    int end = -kMax;
    for (size_t j = 0; j <= kPhases; j++) {
      sum_weights(0.5f + static_cast<float>(j) / kPhases, tent, phases[j]);
      rows[i].first = std::min(rows[i].first, phases[j].first);
      end = std::max(end, phases[j].first + phases[j].count);
    }
    rows[i].count = end - rows[i].first;
    for (size_t j = 0; j <= kPhases; j++) {
      rows[i].weights[j].fill(0.0f);
      std::copy_n(phases[j].weights, phases[j].count,
                  &rows[i].weights[j][static_cast<size_t>(phases[j].first - rows[i].first)]);
    }
    rows[i].weights[kPhases + 1] = rows[i].weights[kPhases];
  }
}

namespace {

// Positions along one axis, and the member of TexelFilter that receives their weights.
struct Axis {
  float places[kMaxAlike];
  std::span<TexelFilter> filters;
  TexelWeights TexelFilter::*weights;
};

}  // namespace

// The loops here and below always run over all kMaxAlike positions, which compilers turn into a few instructions.
ODS_WIDE static void interpolate(const Axis& axis) {
  Position positions[kMaxAlike];
  for (size_t i = 0; i < kMaxAlike; i++) positions[i] = split(axis.places[i]);
  Four weights = cubic_weights(positions[0].beyond);
  for (size_t i = 0; i < axis.filters.size(); i++) {
    TexelWeights& to = axis.filters[i].*axis.weights;
    to.first = positions[i].texel - 1;
    to.count = 4;
    // A row that is level in the picture has the same weights everywhere.
    if (i > 0 && positions[i].beyond != positions[i - 1].beyond) weights = cubic_weights(positions[i].beyond);
    std::memcpy(to.weights, &weights, sizeof weights);
  }
}

ODS_WIDE static void look_up_weights(const TentTable::Row& row, const Axis& axis) {
  Position positions[kMaxAlike];
  for (size_t i = 0; i < kMaxAlike; i++) positions[i] = split_exactly(axis.places[i]);
  for (size_t i = 0; i < axis.filters.size(); i++) {
    const float place = positions[i].beyond * TentTable::kPhases;
    const size_t phase = std::min<size_t>(static_cast<unsigned>(place), TentTable::kPhases);
    const float beyond = place - static_cast<float>(phase);
    const float *a = row.weights[phase].data(), *b = row.weights[phase + 1].data();
    TexelWeights& to = axis.filters[i].*axis.weights;
    to.first = positions[i].texel + row.first;
    to.count = row.count;
    for (int k = 0; k < row.count; k += 4) {
      Four here, next;
      std::memcpy(&here, a + k, sizeof here);
      std::memcpy(&next, b + k, sizeof next);
      here += (next - here) * beyond;
      std::memcpy(to.weights + k, &here, sizeof here);
    }
  }
}

static void set_weights(float square, const Axis& axis) {
  if (square < kMinRadius * kMinRadius) return interpolate(axis);
  const float step = square * TentTable::kSteps + 0.5f;
  if (step < TentTable::kSquares) {
    static const TentTable kTable;  // takes a few milliseconds; computed on first use
    return look_up_weights(kTable.rows[static_cast<size_t>(step)], axis);
  }
  const Tent tent = make_tent(square);
  for (size_t i = 0; i < axis.filters.size(); i++) {
    sum_weights(axis.places[i], tent, axis.filters[i].*axis.weights);
  }
}

std::optional<TexelTents> texel_tents(const Footprint& footprint) {
  // Beyond this the ellipse is so skewed that separate columns and rows describe a different one.
  const float kMaxLean = 0.1f;
  // Skew has no effect if it moves the ends of the ellipse's tent sideways by at most this many texels.
  const float kMaxAside = 0.05f;
  // A filter up to this radius fits into TexelWeights.
  const float kMaxRadius = 12.0f;
  // An ellipse within this circle is only interpolated, whatever its skew.
  const float kSharp = 1.0f + kMinRadius * kMinRadius;
  const vec2 dx = footprint.dx, dy = footprint.dy;
  const float xx = dx.x * dx.x + dy.x * dy.x, yy = dx.y * dx.y + dy.y * dy.y, xy = dx.x * dx.y + dy.x * dy.y;
  if (xx < kSharp && yy < kSharp && xy * xy < (kSharp - xx) * (kSharp - yy)) return TexelTents{};
  const bool straight = xy * xy <= kMaxLean * kMaxLean * xx * yy;
  const bool upright = xy * xy * (std::max(xx, yy) - 1.0f) <= kMaxAside * kMaxAside * (xx - yy) * (xx - yy);
  if (!(xx + yy < kMaxRadius * kMaxRadius && (straight || upright))) return std::nullopt;
  return TexelTents{std::max(xx - 1.0f, 0.0f), std::max(yy - 1.0f, 0.0f)};
}

void texel_filters(const TexelTents& tents, std::span<const vec2> places, TexelFilter* filters) {
  Axis across{{}, {filters, places.size()}, &TexelFilter::across};
  Axis down{{}, {filters, places.size()}, &TexelFilter::down};
  for (size_t i = 0; i < places.size(); i++) across.places[i] = places[i].x, down.places[i] = places[i].y;
  set_weights(tents.across, across);
  set_weights(tents.down, down);
}

}  // namespace ods
