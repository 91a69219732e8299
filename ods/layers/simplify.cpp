// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/simplify.h"

#include <meshoptimizer.h>

namespace ods {

std::vector<uint> first_equal(const std::vector<vec3>& positions) {
  std::vector<uint> first(positions.size());
  meshopt_generateVertexRemap(first.data(), nullptr, positions.size(), positions.data(), positions.size(),
                              sizeof(vec3));
  return first;
}

std::vector<uvec3> simplified(const std::vector<vec3>& positions, const std::vector<uvec3>& triangles, float error,
                              Borders borders) {
  if (triangles.empty()) return {};
  const float* const first = &positions[0].x;
  // The library's errors are relative to the extent.
  const float scale = meshopt_simplifyScale(first, positions.size(), sizeof(vec3));
  std::vector<uvec3> left(triangles.size());
  const size_t indices =
      meshopt_simplify(&left[0].x, &triangles[0].x, 3 * triangles.size(), first, positions.size(), sizeof(vec3), 0,
                       error / scale, borders == Borders::kStay ? meshopt_SimplifyLockBorder : 0, nullptr);
  left.resize(indices / 3);
  return left;
}

std::vector<uint> leave_out_unused(std::vector<vec3>& positions, std::vector<uvec3>& triangles) {
  std::vector<uint> index(positions.size(), ~0u), kept;
  for (uvec3& triangle : triangles) {
    for (int corner = 0; corner < 3; corner++) {
      uint& to = index[triangle[corner]];
      if (to == ~0u) {
        to = static_cast<uint>(kept.size());
        kept.push_back(triangle[corner]);
      }
      triangle[corner] = to;
    }
  }
  std::vector<vec3> used;
  for (const uint old : kept) used.push_back(positions[old]);
  positions = std::move(used);
  return kept;
}

}  // namespace ods
