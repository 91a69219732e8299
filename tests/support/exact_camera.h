// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Shared by the reference cameras in double precision.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ods/camera/stereo_camera.h"
#include "tests/support/statistics.h"

namespace ods {

inline const double kExactPi = std::numbers::pi;

struct ExactRay {
  glm::dvec3 origin, direction;
};

// The merges that are functions of the elevation: all but maps.
inline std::vector<int> closed_merges() {
  std::vector<int> merges(kMerges.begin(), kMerges.end());
  std::erase(merges, kMergeMap);
  return merges;
}

inline int any_closed_merge(Dice& dice) {
  const std::vector<int> merges = closed_merges();
  return merges[static_cast<size_t>(dice.next() * static_cast<float>(merges.size())) % merges.size()];
}

// phi: radians above the horizon or below it.
inline double exact_factor(const PoleMergeSetting& merge, double phi) {
  const double start = double{merge.start},
               t = std::clamp((std::abs(phi) * 180.0 / kExactPi - start) / (double{merge.end} - start), 0.0, 1.0);
  double left = 1.0 - t;
  if (merge.mode == kMergeNone) return 1.0;
  if (merge.mode == kMergePower) return 1.0 - std::pow(t, double{merge.exponent});
  if (merge.mode == kMergeCosine) left = std::max(std::cos(t * kExactPi / 2.0), 0.0);
  if (merge.mode == kMergeSmoothstep) left = 1.0 - t * t * (3.0 - 2.0 * t);
  if (merge.mode == kMergeSmootherstep) left = 1.0 - t * t * t * (10.0 + t * (-15.0 + t * 6.0));
  if (merge.mode == kMergeGaussian) left = (std::exp(-t * t) - 0.36787944117144233) / 0.63212055882855767;
  if (merge.mode == kMergeTiltBrush) left = 1.0 - std::sin(t / (2.0 * kExactPi));
  return std::pow(left, double{merge.exponent});
}

inline double angle_between(glm::dvec3 a, glm::dvec3 b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

// The interpolated value of a lat-long map, in a direction of the camera's frame.
inline double exact_map_at(const Image& map, glm::dvec3 d) {
  const double x = (std::atan2(d.x, -d.z) / kExactPi + 1.0) / 2.0 * map.width - 0.5;
  const double y = (0.5 - std::atan2(d.y, std::hypot(d.x, d.z)) / kExactPi) * map.height - 0.5;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const auto texel = [&](int i, int j) {
    return double{*map.at((i + map.width) % map.width, std::clamp(j, 0, map.height - 1))};
  };
  const auto row = [&](int j) { return glm::mix(texel(x0, j), texel(x0 + 1, j), x - x0); };
  return glm::mix(row(y0), row(y0 + 1), y - y0);
}

}  // namespace ods
