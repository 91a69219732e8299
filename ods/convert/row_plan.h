// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The plan for a row of a conversion's target: stretches whose source positions follow a parabola, and single pixels.
// It depends only on the cameras, so the pictures of a video share it.
#pragma once
#include <vector>

#include "ods/convert/mapping.h"
#include "ods/convert/texel_filter.h"

namespace ods {

// Part of a row whose positions follow a parabola to within 1/100 texel, so that its pixels need no trigonometry of
// their own.
struct Stretch {
  int x = 0;  // the first pixel
  int count = 0;
  int source_eye = 0;
  Cell cell;        // in the source
  float per_pixel;  // step of t from one pixel to the next
  vec2 start;
  vec2 step;              // from the start to the middle
  vec2 bend;              // difference between the second step and the first
  vec2 down[3];           // offset to the position one pixel below, for each of the three
  bool is_sharp = false;  // the picture is interpolated everywhere, not averaged (TexelTents())

  // `t`: 0 at the start, 1 in the middle, 2 at the end. Footprints change slowly.
  vec2 at(float t) const { return start + step * t + bend * (0.5f * t * (t - 1.0f)); }
  Footprint footprint(float t) const {
    const vec2 dy = t < 1.0f ? mix(down[0], down[1], t) : mix(down[1], down[2], t - 1.0f);
    return {(step + bend * (t - 0.5f)) * per_pixel, dy};
  }
};

// A pixel that is computed separately: the sum of the picture at weighted positions, over the weight of the visible
// ones.
struct SinglePixel {
  int x = 0;
  Place middle;
  size_t first = 0;  // index of its first position in RowPlan::places
  size_t count = 0;
  float weight = 1.0f;
};

struct RowPlan {
  std::vector<Stretch> stretches;
  std::vector<SinglePixel> singles;
  std::vector<WeightedPlace> places;
  int empty = 0;  // pixels that are empty in the picture; they are in neither list
};

// Plans row y of the target's eye with this index. Pixels that the target does not want are in neither list.
RowPlan plan_row(const Mapping& mapping, int index, int y);

// The movement of the source position from one target pixel to the next. `place`: the pixel's.
Footprint find_footprint(const Mapping& mapping, int index, int x, int y, const Place& place);

// Returns whether the points, offset from a position, are all in the cell.
bool stays_in_cell(const Place& place, const Cell& cell, const std::vector<FilterPoint>& points);

}  // namespace ods
