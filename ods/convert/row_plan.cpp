// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/row_plan.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ods {

constexpr int kLongStretch = 64;
constexpr int kShortStretch = 8;

namespace {

// A row of a cell of the target.
struct CellRow {
  int index;  // index of the eye, in the target
  int y;
  Cell cell;
};

// The position of a pixel's centre, and the position of the pixel below or above, away from the closer edge of the
// cell, because beyond a pole another picture begins.
struct Node {
  Place at;
  Place beside;
  Cell cell;             // in the source
  bool is_seam = false;  // the other lens shows it, too
};

}  // namespace

// The direction away from the closer edge.
static int way_down(const CellRow& row) {
  return 2 * row.y < row.cell.top + row.cell.bottom ? 1 : -1;
}

static Node find_node(const Mapping& mapping, const CellRow& row, int x) {
  const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(row.y) + 0.5f;
  const vec2 home = mapping.home_of((row.cell.left + row.cell.right) / 2, (row.cell.top + row.cell.bottom) / 2);
  const Place at = mapping.find(row.index, home, mapping.uv_of(px, py));
  const Place beside = mapping.find(row.index, home, mapping.uv_of(px, py + static_cast<float>(way_down(row))));
  return {at, beside, mapping.source_cell(at),
          mapping.other_lens(row.index, home, mapping.uv_of(px, py)).weight > 0.0f};
}

static std::optional<Stretch> find_stretch(const Node& first, const Node& middle, const Node& last, int pixels,
                                           int way) {
  Stretch stretch{0, 0, first.at.source_eye, first.cell, 2.0f / static_cast<float>(pixels), first.at.at, {}, {}, {}};
  stretch.step = middle.at.at - first.at.at;
  stretch.bend = last.at.at - 2.0f * middle.at.at + first.at.at;
  vec2* down = stretch.down;
  for (const Node* node : {&first, &middle, &last}) {
    if (!node->at.seen || !node->beside.seen || node->is_seam || node->at.source_eye != stretch.source_eye ||
        node->beside.source_eye != stretch.source_eye || !same_cell(node->cell, stretch.cell))
      return {};
    *down++ = (node->beside.at - node->at.at) * static_cast<float>(way);
  }
  const float texels = length(stretch.step) * stretch.per_pixel;
  const float turn = length(stretch.down[1] - stretch.down[0]) + length(stretch.down[2] - stretch.down[1]);
  const float maximum = pixels > 2 * kShortStretch ? 8.0f / static_cast<float>(pixels) : 1.0f;
  if (length(stretch.bend) > maximum * (1.0f + 0.1f * texels) ||
      turn > maximum * (0.25f + 0.25f * length(stretch.down[1])))
    return {};
  // Between two sharp footprints all are sharp, because the footprints whose ellipse is within a circle are a convex
  // set.
  const auto is_sharp = [&](float t) { return texel_tents(stretch.footprint(t)) == TexelTents(); };
  stretch.is_sharp = is_sharp(0.0f) && is_sharp(1.0f) && is_sharp(2.0f);
  return stretch;
}

// --- single pixels --------------------------------------------------------------------------------------------------

// Tries adjacent pixels in the same cell of the source, first the one away from the target's edge; then closer points.
Footprint find_footprint(const Mapping& mapping, int index, int x, int y, const Place& place) {
  const Cell cell = mapping.cell_at(x, y);
  const vec2 middle(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  const vec2 home = mapping.uv_of(middle.x, middle.y);
  const Projection& projection = mapping.source.camera.projection;
  const Extent size = mapping.source.picture->size;
  const Cell own = cell_of(projection, size, place.at);
  const bool round = has_range(projection.kind) && mapping.source.picture->maps.empty();  // columns wrap
  const float turn = static_cast<float>(size.width) * 2.0f * kPi / projection.span.x;     // columns of 360 degrees
  const auto neighbour = [&](vec2 way, bool away) {
    for (const float step : {away ? -1.0f : 1.0f, away ? 1.0f : -1.0f, 0.1f, -0.1f}) {
      const vec2 at = middle + way * step;
      const Place there = mapping.find(index, home, mapping.uv_of(at.x, at.y));
      if (!there.seen || there.source_eye != place.source_eye || !same_cell(own, cell_of(projection, size, there.at)))
        continue;
      vec2 move = there.at - place.at;
      if (round) move.x -= turn * std::round(move.x / turn);
      return move / step;
    }
    return vec2(0.0f);
  };
  return {neighbour({1.0f, 0.0f}, 2 * x > cell.left + cell.right),
          neighbour({0.0f, 1.0f}, 2 * y > cell.top + cell.bottom)};
}

bool stays_in_cell(const Place& place, const Cell& cell, const std::vector<FilterPoint>& points) {
  return std::all_of(points.begin(), points.end(), [&](const FilterPoint& point) {
    const vec2 at = place.at + point.texels;
    return at.x >= static_cast<float>(cell.left) && at.x < static_cast<float>(cell.right) &&
           at.y >= static_cast<float>(cell.top) && at.y < static_cast<float>(cell.bottom);
  });
}

// Returns whether the footprint predicts the positions of the filter's far points correctly.
static bool is_flat(const Mapping& mapping, int index, vec2 home, const Place& place,
                    const std::vector<FilterPoint>& points) {
  if (!stays_in_cell(place, mapping.source_cell(place), points)) return false;
  for (const FilterPoint& point : {points.front(), points.back()}) {
    const Place there = mapping.find(index, home, home + point.pixels * mapping.uv_of(1.0f, 1.0f));
    if (!there.seen || there.source_eye != place.source_eye || length(there.at - place.at - point.texels) > 0.1f)
      return false;
  }
  return true;
}

// --- rows -----------------------------------------------------------------------------------------------------------

namespace {

class RowPlanner {
 public:
  RowPlanner(const Mapping& mapping, int index, int y) : mapping_(mapping), index_(index), y_(y) {}

  RowPlan plan() {
    for (int x = 0; x < mapping_.size.width;) {
      const Cell cell = mapping_.cell_at(x, y_);
      plan_cell({index_, y_, cell});
      x = cell.right;
    }
    return plan_;
  }

 private:
  void plan_cell(const CellRow& row) {
    Node first = find_node(mapping_, row, row.cell.left);
    for (int x = row.cell.left; x < row.cell.right;) {
      int pixels = kLongStretch;
      while (pixels > kShortStretch && pixels / 2 >= row.cell.right - x) pixels /= 2;
      const Node last = find_node(mapping_, row, x + pixels);
      plan_between(row, x, pixels, first, last);
      first = last;
      x += pixels;
    }
  }

  // Plans a range of pixels; its end may be beyond the cell's.
  void plan_between(const CellRow& row, int x, int pixels, const Node& first, const Node& last) {
    if (x >= row.cell.right) return;
    const int end = std::min(x + pixels, row.cell.right), half = pixels / 2;
    const Node middle = find_node(mapping_, row, x + half);
    const bool wanted = mapping_.wants(x, row.y) && mapping_.wants(end - 1, row.y);
    if (auto stretch = find_stretch(first, middle, last, pixels, way_down(row)); stretch && wanted) {
      stretch->x = x, stretch->count = end - x;
      plan_.stretches.push_back(*stretch);
      return;
    }
    if (pixels == kShortStretch) {
      for (; x < end; x++) add_single(x);
      return;
    }
    plan_between(row, x, half, first, middle);
    plan_between(row, x + half, half, middle, last);
  }

  void add_single(int x) {
    if (!mapping_.wants(x, y_)) return;
    const vec2 home = mapping_.home_of(x, y_), size = mapping_.uv_of(1.0f, 1.0f);
    const Place place = mapping_.find(index_, home, home);
    if (!place.seen) {
      plan_.empty++;
      return;
    }
    filter_points(find_footprint(mapping_, index_, x, y_, place), points_);
    const bool is_near = points_.size() == 1 || is_flat(mapping_, index_, home, place, points_);
    SinglePixel pixel{x, place, plan_.places.size()};
    float weight = 0.0f;
    for (const FilterPoint& point : points_) {
      const Place at = is_near ? Place{place.source_eye, place.at + point.texels, true}
                               : mapping_.find(index_, home, home + point.pixels * size);
      if (!at.seen) continue;
      const WeightedPlace other = mapping_.other_lens(index_, home, home + point.pixels * size);
      plan_.places.push_back({at, point.weight * (1.0f - other.weight)});
      if (other.weight > 0.0f) plan_.places.push_back({other.place, point.weight * other.weight});
      weight += point.weight;
    }
    pixel.count = plan_.places.size() - pixel.first;
    if (!is_near && weight > 0.0f && weight <= 0.9999f) pixel.weight = weight;
    plan_.singles.push_back(pixel);
  }

  const Mapping& mapping_;
  int index_;
  int y_;
  RowPlan plan_;
  std::vector<FilterPoint> points_;
};

}  // namespace

RowPlan plan_row(const Mapping& mapping, int index, int y) {
  return RowPlanner(mapping, index, y).plan();
}

}  // namespace ods
