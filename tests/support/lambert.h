// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The light of a polygon, as a closed form.
#pragma once
#include <cmath>
#include <vector>

#include "ods/kernel/math.h"

namespace ods {

// Lambert's formula: half the sum of the angles of the lamp's edges, each times the cosine between the normal of its
// plane and the surface's.
inline double polygon_irradiance(glm::dvec3 p, const std::vector<glm::dvec3>& corners, double radiance,
                                 glm::dvec3 normal = {0.0, 1.0, 0.0}) {
  double sum = 0.0;
  for (size_t i = 0; i < corners.size(); i++) {
    const glm::dvec3 a = normalize(corners[i] - p), b = normalize(corners[(i + 1) % corners.size()] - p);
    sum += std::acos(dot(a, b)) * dot(normalize(cross(a, b)), normal);
  }
  return std::abs(sum) * 0.5 * radiance;
}

}  // namespace ods
