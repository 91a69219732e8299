// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Checks that all of our triangle meshes must pass.
#pragma once
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "ods/kernel/scene_data.h"

namespace ods {

// Finite vertices, unit normals, corners in range, no flat triangles, normals on the side defined by the winding.
inline void expect_sound(std::span<const Vertex> vertices, std::span<const uvec3> triangles) {
  ASSERT_FALSE(triangles.empty());
  for (const Vertex& v : vertices) {
    const float sum = v.position.x + v.position.y + v.position.z + v.uv0.x + v.uv0.y;
    ASSERT_TRUE(std::isfinite(sum));
    ASSERT_NEAR(length(v.normal), 1.0f, 1e-4f);
  }
  for (const uvec3& t : triangles) {
    ASSERT_LT(max(t.x, max(t.y, t.z)), vertices.size());
    const Vertex &a = vertices[t.x], &b = vertices[t.y], &c = vertices[t.z];
    const vec3 facing = cross(b.position - a.position, c.position - a.position);
    ASSERT_GT(length(facing), 0.0f);
    ASSERT_GT(dot(facing, a.normal + b.normal + c.normal), 0.0f);
  }
}

// The number of directed edges without a partner in the other direction. Corners within a hundredth of a millimetre
// count as one.
inline int open_edges(std::span<const Vertex> vertices, std::span<const uvec3> triangles) {
  using Place = std::array<long, 3>;
  const auto place = [&](uint i) {
    const vec3 p = vertices[i].position;
    return Place{std::lround(p.x * 1e5f), std::lround(p.y * 1e5f), std::lround(p.z * 1e5f)};
  };
  std::map<std::pair<Place, Place>, int> balance;
  for (const uvec3& t : triangles) {
    for (int i = 0; i < 3; i++) {
      const Place from = place(t[i]), to = place(t[(i + 1) % 3]);
      if (from < to) balance[{from, to}]++;
      if (to < from) balance[{to, from}]--;
    }
  }
  int open = 0;
  for (const auto& [edge, count] : balance) open += std::abs(count);
  return open;
}

inline double enclosed_volume(std::span<const Vertex> vertices, std::span<const uvec3> triangles) {
  double six = 0.0;
  for (const uvec3& t : triangles) {
    six += dot(vertices[t.x].position, cross(vertices[t.y].position, vertices[t.z].position));
  }
  return six / 6.0;
}

}  // namespace ods
