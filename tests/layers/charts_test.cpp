// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/charts.h"

#include <gtest/gtest.h>

#include <random>

namespace ods::charts_test {

TEST(Charts, ArePackedBesideEachOther) {
  constexpr int kSize = 128;
  std::mt19937 random(5);
  std::vector<Chart> charts(300);
  std::vector<Chart*> all;
  for (Chart& chart : charts) {
    chart.width = 1 + static_cast<int>(random() % 40);
    chart.height = 1 + static_cast<int>(random() % 20);
    all.push_back(&chart);
  }
  const int textures = pack_charts(all, kSize, 3);
  std::vector<char> taken(static_cast<size_t>(textures) * kSize * kSize);
  size_t area = 0;
  for (const Chart& chart : charts) {
    ASSERT_GE(chart.texture, 3);
    ASSERT_LT(chart.texture, 3 + textures);
    ASSERT_LE(chart.x + chart.width, kSize);
    ASSERT_LE(chart.y + chart.height, kSize);
    for (int y = chart.y; y < chart.y + chart.height; y++) {
      for (int x = chart.x; x < chart.x + chart.width; x++) {
        char& texel = taken[static_cast<size_t>(((chart.texture - 3) * kSize + y) * kSize + x)];
        EXPECT_EQ(texel, 0);
        texel = 1;
        area++;
      }
    }
  }
  EXPECT_GT(static_cast<double>(area), 0.8 * (textures - 1) * kSize * kSize);
  EXPECT_EQ(pack_charts({}, kSize, 3), 0);
}

// A place that sees everything within 100 m.
Probe open_probe() {
  Probe probe;
  probe.box.size = vec3(0.2f);
  for (const vec3& place : places_of(probe.box)) {
    DistanceMap& map = probe.maps.emplace_back(DistanceMap{place, PageGrid(16, 1), {}, {}});
    map.distances.assign(static_cast<size_t>(map.grid.pages() * map.grid.size() * map.grid.size()), 100.0f);
  }
  return probe;
}

// A wall 2 m ahead and a step of it to the right that recedes: two charts, each of connected pieces that are flat.
TEST(Charts, AreFlatAndConnected) {
  PieceMesh mesh;
  mesh.positions = {{-0.2f, 0, -2},    {0, 0, -2},        {0, 0.2f, -2},
                    {-0.2f, 0.2f, -2}, {0.05f, 0, -2.4f}, {0.05f, 0.2f, -2.4f}};
  mesh.pieces = {{{0, 1, 2}}, {{0, 2, 3}}, {{1, 4, 5}}, {{1, 5, 2}}};
  for (Piece& piece : mesh.pieces) piece.state = PieceState::kChart;
  const float pixel = pixel_angle(2048);
  std::vector<Chart> charts = make_charts(open_probe(), {mesh}, pixel, 256);
  ASSERT_EQ(charts.size(), 2u);
  EXPECT_EQ(charts[0].pieces, (std::vector<size_t>{0, 1}));
  EXPECT_EQ(charts[1].pieces, (std::vector<size_t>{2, 3}));
  // 0.2 m at 2 m are 0.1 radians.
  EXPECT_NEAR(static_cast<float>(charts[0].width - 2 * Chart::kGutter), 0.1f / pixel, 0.06f * 0.1f / pixel + 1.0f);
  for (const Chart& chart : charts) {
    for (const size_t piece : chart.pieces) {
      for (int i = 0; i < 3; i++) {
        const vec2 at = in_chart(chart, mesh.positions[mesh.pieces[piece].corners[i]]);
        EXPECT_GE(std::min(at.x, at.y), static_cast<float>(Chart::kGutter) - 0.01f);
        EXPECT_LE(at.x, static_cast<float>(chart.width - Chart::kGutter) + 0.01f);
        EXPECT_LE(at.y, static_cast<float>(chart.height - Chart::kGutter) + 0.01f);
      }
    }
  }
}

}  // namespace ods::charts_test
