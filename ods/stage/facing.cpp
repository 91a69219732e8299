// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/facing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace ods {

namespace {

constexpr int kColumns = 120, kRows = 13;
constexpr float kStep = 360.0f / kColumns;  // degrees between columns
constexpr float kRowStep = 6.0f;
constexpr float kHalfView = 45.0f;  // degrees
constexpr int kHalfColumns = static_cast<int>(kHalfView / kStep);

float elevation_of(int row) {
  return kRowStep * static_cast<float>(row - kRows / 2);
}

struct Panorama {
  std::vector<std::array<Sight, kRows>> columns;
  std::vector<int> sizes;  // per instance: number of directions in which it is seen
  float farthest = 0.0f;   // distance of the farthest surface

  const Sight& at(int column, int row) const {
    return columns[static_cast<size_t>((column + kColumns) % kColumns)][static_cast<size_t>(row)];
  }
  float horizontal(int column, int row) const {
    return at(column, row).distance * std::cos(glm::radians(elevation_of(row)));
  }
};

Panorama panorama_around(const SceneRays& rays, vec3 eye) {
  Panorama view;
  view.columns.resize(kColumns);
  view.sizes.resize(rays.scene().instances.size());
  for (int i = 0; i < kColumns; i++) {
    for (int row = 0; row < kRows; row++) {
      const vec3 way = direction_at(kStep * static_cast<float>(i), elevation_of(row));
      const Sight sight = rays.look(eye, way);
      view.columns[static_cast<size_t>(i)][static_cast<size_t>(row)] = sight;
      if (sight.leaves()) continue;
      view.farthest = std::max(view.farthest, sight.distance);
      view.sizes[static_cast<size_t>(sight.instance)]++;
    }
  }
  return view;
}

// The farthest horizontal distance in a column; infinite under an open sky, but not through a window.
float reach_of(const Panorama& view, int column) {
  if (view.at(column, kRows - 1).leaves()) return std::numeric_limits<float>::infinity();
  float farthest = 0.0f;
  for (int row = 0; row < kRows; row++) {
    if (!view.at(column, row).leaves()) farthest = std::max(farthest, view.horizontal(column, row));
  }
  return farthest;
}

// The distance of the backdrop behind thin objects in a column: the smaller of the two sides' maximum distances, or the
// column's own if that is larger.
float backdrop(const std::vector<float>& reaches, int column) {
  const int kThin = static_cast<int>(18.0f / kStep);
  float left = 0.0f, right = 0.0f;
  for (int off = 1; off <= kThin; off++) {
    left = std::max(left, reaches[static_cast<size_t>((column - off + kColumns) % kColumns)]);
    right = std::max(right, reaches[static_cast<size_t>((column + off) % kColumns)]);
  }
  return std::max(reaches[static_cast<size_t>(column)], std::min(left, right));
}

// The contents of a column of directions.
struct Column {
  float things = 0.0f;   // fraction of its rows with objects
  float cut = 0.0f;      // 1 if an object extends above the view
  float depth = 0.0f;    // log2 of the backdrop's distance
  float blocked = 0.0f;  // 1 if a close object fills the column from bottom to top
};

Column column_of(const Panorama& view, int column, float behind) {
  constexpr float kLevel = 0.7071f, kBefore = 0.85f, kNear = 0.5f, kSmall = 0.03f * kColumns * kRows;
  Column sum;
  sum.depth = std::log2(std::max(std::min(behind, view.farthest), 1e-6f));
  int near = 0;
  for (int row = 0; row < kRows; row++) {
    const Sight& sight = view.at(column, row);
    if (sight.leaves() || !sight.front || std::abs(sight.normal.y) > kLevel) continue;
    const float distance = view.horizontal(column, row);
    if (row >= kRows / 2 && distance < kNear * behind) near++;
    const bool is_small = static_cast<float>(view.sizes[static_cast<size_t>(sight.instance)]) <= kSmall;
    if (distance > kBefore * behind && !is_small) continue;
    sum.things += 1.0f / kRows;
    if (row == kRows - 1) sum.cut = 1.0f;
  }
  if (near < kRows - kRows / 2) return sum;
  sum.blocked = 1.0f;
  sum.things = sum.cut = 0.0f;
  return sum;
}

std::vector<Column> columns_around(const SceneRays& rays, vec3 eye) {
  const Panorama view = panorama_around(rays, eye);
  std::vector<float> reaches;
  for (int i = 0; i < kColumns; i++) reaches.push_back(reach_of(view, i));
  std::vector<Column> columns;
  for (int i = 0; i < kColumns; i++) columns.push_back(column_of(view, i, backdrop(reaches, i)));
  return columns;
}

// middle: index of the column in the middle of the view.
float worth_of_view(const std::vector<Column>& columns, int middle) {
  constexpr float kDepth = 0.2f, kDeeper = 0.5f, kShallow = 0.3f, kCut = 0.3f, kBlocked = 1.0f;
  Column wide, centre, all;  // weighted sums over the view, over its middle, and all around
  float wide_weights = 0.0f, centre_weights = 0.0f;
  const auto at = [&](int off) -> const Column& {
    return columns[static_cast<size_t>((middle + off + kColumns) % kColumns)];
  };
  for (int off = -kHalfColumns; off <= kHalfColumns; off++) {
    const float weight = std::cos(glm::radians(90.0f / kHalfView * kStep * static_cast<float>(off)));
    const float cube = weight * weight * weight;
    wide_weights += weight, centre_weights += cube;
    wide.things += weight * at(off).things;
    wide.cut += weight * at(off).cut;
    centre.depth += cube * at(off).depth;
    centre.blocked += cube * at(off).blocked;
  }
  for (const Column& column : columns) all.depth += column.depth / kColumns;
  const float sides = 0.5f * (at(-kHalfColumns).things + at(kHalfColumns).things);
  const float deeper = std::max(centre.depth / centre_weights - all.depth - kDeeper, 0.0f);
  const float shallower = std::max(all.depth - centre.depth / centre_weights - kDeeper, 0.0f);
  return wide.things / wide_weights + kDepth * deeper - kShallow * shallower -
         kCut * (sides + wide.cut / wide_weights) - kBlocked * centre.blocked / centre_weights;
}

}  // namespace

float best_yaw(const SceneRays& rays, vec3 eye) {
  const std::vector<Column> columns = columns_around(rays, eye);
  int best = 0;
  float best_worth = worth_of_view(columns, 0);
  for (int i = 1; i < kColumns; i++) {
    const float worth = worth_of_view(columns, i);
    if (worth <= best_worth + 1e-3f * std::abs(best_worth)) continue;
    best = i, best_worth = worth;
  }
  const float yaw = kStep * static_cast<float>(best);
  return yaw > 180.0f ? yaw - 360.0f : yaw;
}

}  // namespace ods
