// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The texels that a textured triangle reads, and the part of one that a masked surface covers.
#pragma once
#include <algorithm>
#include <cmath>

#include "ods/camera/texel_rays.h"
#include "ods/kernel/math.h"

namespace ods {

// Calls visit() for every texel of a size x size texture that a bilinear filter may read anywhere in a triangle:
// those whose centre is in the triangle, or less than a texel beside it along both axes. Corners in texels. A superset:
// at acute corners there are some more. visit(x, y, inside) returns whether to continue; inside: the centre is in the
// triangle.
template <typename Visit>
void for_each_texel(const vec2 (&corners)[3], int size, const Visit& visit) {
  const vec2 low = min(min(corners[0], corners[1]), corners[2]) - 1.5f;
  const vec2 high = max(max(corners[0], corners[1]), corners[2]) + 0.5f;
  const int x0 = std::max(static_cast<int>(std::ceil(low.x)), 0), y0 = std::max(static_cast<int>(std::ceil(low.y)), 0);
  const int x1 = std::min(static_cast<int>(std::floor(high.x)), size - 1);
  const int y1 = std::min(static_cast<int>(std::floor(high.y)), size - 1);
  const vec2 ab = corners[1] - corners[0], ac = corners[2] - corners[0];
  const float turn = ab.x * ac.y - ab.y * ac.x < 0.0f ? -1.0f : 1.0f;
  for (int y = y0; y <= y1; y++) {
    for (int x = x0; x <= x1; x++) {
      const vec2 center(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      bool read = true, inside = true;
      for (int i = 0; i < 3 && read; i++) {
        const vec2 edge = (corners[(i + 1) % 3] - corners[i]) * turn, to = center - corners[i];
        const float beside = edge.x * to.y - edge.y * to.x;
        read = beside >= -(abs(edge.x) + abs(edge.y));
        inside = inside && beside >= 0.0f;
      }
      if (read && !visit(x, y, inside)) return;
    }
  }
}

// Samples a masked texel on a grid. Returns the ray of the covered sample that is nearest to its centre, and the part of
// the texel that is covered, 0..1. shoot(offset) returns the ray at an offset from the centre, in texels; direction 0 if
// nothing is there.
template <typename Shoot>
TexelRay covered_ray(const Shoot& shoot, float& coverage) {
  constexpr int kGrid = 4;
  TexelRay best{};
  float nearest = 1e30f;
  int covered = 0;
  for (int i = 0; i < kGrid * kGrid; i++) {
    const vec2 offset = (vec2(i % kGrid, i / kGrid) + 0.5f) / static_cast<float>(kGrid) - 0.5f;
    const TexelRay ray = shoot(offset);
    if (ray.direction == vec3(0.0f)) continue;
    covered++;
    if (dot(offset, offset) < nearest) nearest = dot(offset, offset), best = ray;
  }
  coverage = static_cast<float>(covered) / (kGrid * kGrid);
  return best;
}

}  // namespace ods
