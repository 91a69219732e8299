// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/footprint.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace ods::footprint_test {

constexpr int kSize = 24;

// Every texel that a bilinear filter reads at any point of a triangle is visited, and none that is far away.
TEST(Footprint, HasAllTexelsThatAFilterReads) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> any(0.0f, kSize), part(0.0f, 1.0f);
  for (int i = 0; i < 200; i++) {
    const vec2 corners[3] = {{any(random), any(random)}, {any(random), any(random)}, {any(random), any(random)}};
    std::set<std::pair<int, int>> visited, within;
    for_each_texel(corners, kSize, [&](int x, int y, bool inside) {
      EXPECT_TRUE(visited.emplace(x, y).second);
      if (inside) within.emplace(x, y);
      return true;
    });
    for (int k = 0; k < 500; k++) {
      float u = part(random), v = part(random);
      if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
      const vec2 at = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
      const int x = static_cast<int>(std::floor(at.x - 0.5f)), y = static_cast<int>(std::floor(at.y - 0.5f));
      for (const auto& texel : {std::pair(x, y), std::pair(x + 1, y), std::pair(x, y + 1), std::pair(x + 1, y + 1)}) {
        if (std::min(texel.first, texel.second) < 0 || std::max(texel.first, texel.second) >= kSize) continue;
        EXPECT_TRUE(visited.contains(texel)) << texel.first << " " << texel.second;
      }
    }
    for (const auto& [x, y] : within) {
      const vec2 center(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const vec2 low = min(min(corners[0], corners[1]), corners[2]),
                 high = max(max(corners[0], corners[1]), corners[2]);
      EXPECT_TRUE(center.x >= low.x && center.y >= low.y && center.x <= high.x && center.y <= high.y);
    }
  }
}

TEST(Footprint, EndsWhereTheVisitorWants) {
  const vec2 corners[3] = {{0, 0}, {20, 0}, {0, 20}};
  int count = 0;
  for_each_texel(corners, kSize, [&](int, int, bool) { return ++count < 5; });
  EXPECT_EQ(count, 5);
}

}  // namespace ods::footprint_test
