// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/depth/depth_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tests/support/ball_in_box.h"

namespace ods::depth_surface_test {

constexpr float kReach = 0.26f;

// A panorama of distances, by direction.
template <typename Distance>
DepthPanorama panorama_of(int size, const Distance& distance) {
  DepthPanorama panorama = empty_panorama(PageGrid(size, 1));
  for (int page = 0; page < panorama.grid.pages(); page++) {
    for (int y = 0; y < size; y++) {
      for (int x = 0; x < size; x++) {
        const float metres = distance(panorama.grid.texel_ray(page, x, y));
        panorama.nearness[index_of(panorama.grid, {page, x, y})] = metres > 0.0f ? 1.0f / metres : 0.0f;
      }
    }
  }
  return panorama;
}

float box_distance(vec3 ray) {
  float box = 1e9f;
  for (int i = 0; i < 3; i++) box = std::min(box, kBox[i] / std::abs(ray[i]));
  return box;
}

// The edges that only one triangle has.
size_t open_edges(const SeenSurface& surface) {
  std::map<std::pair<uint, uint>, int> count;
  for (const uvec3& triangle : surface.triangles) {
    for (int i = 0; i < 3; i++) count[std::minmax(triangle[i], triangle[(i + 1) % 3])]++;
  }
  return static_cast<size_t>(std::ranges::count_if(count, [](const auto& edge) { return edge.second != 2; }));
}

TEST(DepthSurface, OfARoomIsItsWallsWithoutAGap) {
  const SeenSurface surface = depth_surface(panorama_of(264, box_distance), kReach);
  EXPECT_EQ(open_edges(surface), 0u);
  EXPECT_LT(surface.triangles.size(), 40000u);
  EXPECT_GT(surface.triangles.size(), 100u);
  const float pixel = PageGrid(264, 1).pixel();
  for (const vec3& position : surface.positions) {
    const float distance = length(position), wall = box_distance(position / distance);
    EXPECT_LT(kReach * std::abs(1.0f / distance - 1.0f / wall), pixel);
  }
}

TEST(DepthSurface, FacesTheMiddle) {
  const SeenSurface surface = depth_surface(panorama_of(72, box_distance), kReach);
  for (const uvec3& t : surface.triangles) {
    const vec3 a = surface.positions[t.x], b = surface.positions[t.y], c = surface.positions[t.z];
    EXPECT_LE(dot(cross(b - a, c - a), a), 0.0f);
  }
}

// No triangle connects the ball with the walls behind it.
TEST(DepthSurface, IsCutAtEdges) {
  const SeenSurface surface = depth_surface(panorama_of(264,
                                                        [](vec3 ray) {
                                                          return look_at_world({vec3(0.0f), ray}).depth;
                                                        }),
                                            kReach);
  EXPECT_GT(open_edges(surface), 20u);
  const auto is_on_ball = [&](uint vertex) { return length(surface.positions[vertex] - kBall) < 1.2f * kRadius; };
  size_t on_ball = 0;
  for (const uvec3& t : surface.triangles) {
    EXPECT_TRUE(is_on_ball(t.x) == is_on_ball(t.y) && is_on_ball(t.y) == is_on_ball(t.z));
    on_ball += is_on_ball(t.x) ? 1 : 0;
  }
  EXPECT_GT(on_ball, 20u);
}

TEST(DepthSurface, LeavesOutTheSky) {
  const SeenSurface surface =
      depth_surface(panorama_of(72, [](vec3 ray) { return ray.y < -0.2f ? -1.0f / ray.y : 0.0f; }), kReach);
  ASSERT_FALSE(surface.triangles.empty());
  for (const vec3& position : surface.positions) EXPECT_NEAR(position.y, -1.0f, 0.1f);
  EXPECT_TRUE(depth_surface(panorama_of(72, [](vec3) { return 0.0f; }), kReach).triangles.empty());
}

}  // namespace ods::depth_surface_test
