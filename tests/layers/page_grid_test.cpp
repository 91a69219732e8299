// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/page_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ods::page_grid_test {

vec3 any_direction(std::mt19937& random) {
  std::normal_distribution<float> any;
  return normalize(vec3(any(random), any(random), any(random)));
}

TEST(PageGrid, FindsTheDirectionOfEveryPositionAgain) {
  std::mt19937 random(1);
  for (const PageGrid& grid : {PageGrid(64, 1), PageGrid(40, 3)}) {
    for (int i = 0; i < 2000; i++) {
      const vec3 direction = any_direction(random);
      const PagePlace place = place_in_pages(grid, direction * 7.0f);
      ASSERT_GE(place.page, 0);
      ASSERT_LT(place.page, grid.pages());
      EXPECT_GE(place.position.x, PageGrid::kGutter - 1e-3f);
      EXPECT_LE(place.position.y, static_cast<float>(grid.size() - PageGrid::kGutter) + 1e-3f);
      EXPECT_LT(length(from_page(grid, place.page, place.position) - direction), 2e-6f);
      EXPECT_LT(length(to_page(grid, place.page, direction) - place.position), 1e-4f);
    }
  }
}

TEST(PageGrid, HasTheRaysOfTexelsAtTheirCentres) {
  const PageGrid grid(32, 2);
  for (int page = 0; page < grid.pages(); page++) {
    for (int i = 0; i < grid.size(); i++) {
      const vec2 center(static_cast<float>(i) + 0.5f, static_cast<float>(grid.size() - 1 - i) + 0.5f);
      EXPECT_LT(length(grid.texel_ray(page, i, grid.size() - 1 - i) - from_page(grid, page, center)), 1e-6f);
    }
  }
}

// The same point beyond the edge of a page is in the gutter of one page and inside of the other.
TEST(PageGrid, ContinuesInTheGutters) {
  const PageGrid grid(72, 2);
  for (int page = 0; page < grid.pages(); page++) {
    const vec3 beyond = from_page(grid, page, {static_cast<float>(grid.size()) - 0.5f, 30.0f});
    const PagePlace there = place_in_pages(grid, beyond);
    EXPECT_NE(there.page, page);
    EXPECT_LT(length(from_page(grid, there.page, there.position) - beyond), 2e-6f);
  }
}

TEST(PageGrid, ShowsPagesUprightAndUnmirrored) {
  for (int face = 0; face < kFaces; face++) {
    const PageGrid grid(32, 1);
    const vec3 middle = from_page(grid, face, vec2(16.0f));
    const vec3 right = from_page(grid, face, {20.0f, 16.0f}) - middle;
    const vec3 down = from_page(grid, face, {16.0f, 20.0f}) - middle;
    EXPECT_GT(dot(cross(right, down), middle), 0.0f) << face;
    if (std::abs(middle.y) < 0.5f) {
      EXPECT_LT(down.y, 0.0f) << face;
    }
  }
}

// Every step from page to page crosses one of the planes.
TEST(PageGrid, SeparatesPagesByItsPlanes) {
  std::mt19937 random(2);
  const PageGrid grid(40, 3);
  for (int i = 0; i < 3000; i++) {
    const vec3 a = any_direction(random), b = normalize(a + 0.02f * any_direction(random));
    if (place_in_pages(grid, a).page == place_in_pages(grid, b).page) continue;
    bool crossed = false;
    for (int k = 0; k < page_plane_count(grid); k++) {
      const PagePlane plane = page_plane(grid, k);
      crossed |= dot(plane.normal, a) * dot(plane.normal, b) <= 0.0f;
    }
    EXPECT_TRUE(crossed);
  }
}

TEST(PageGrid, HasTheSharpnessOfItsPanorama) {
  EXPECT_EQ(page_grid(8192).size(), 2048);
  EXPECT_EQ(page_grid(8192).across(), 1);
  EXPECT_EQ(page_grid(14400).across(), 2);
  for (const int width : {256, 1000, 4096, 8192, 14400, 32768}) {
    const PageGrid grid = page_grid(width);
    EXPECT_LE(grid.size(), 2048);
    EXPECT_EQ(grid.size() % 4, 0);
    EXPECT_GE(100 * grid.inner() * grid.across() * 4, 99 * width) << width;
  }
}

}  // namespace ods::page_grid_test
