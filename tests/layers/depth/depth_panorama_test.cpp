// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/depth/depth_panorama.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/ball_in_box.h"

namespace ods::depth_panorama_test {

constexpr float kReach = 0.26f;

// The share of texels whose distance and colour are within some percent of the world's.
double share_right(const DepthPanorama& panorama) {
  size_t right = 0, all = 0;
  for (int page = 0; page < panorama.grid.pages(); page++) {
    for (int y = 0; y < panorama.grid.size(); y++) {
      for (int x = 0; x < panorama.grid.size(); x++) {
        const Seen seen = look_at_world({vec3(0.0f), panorama.grid.texel_ray(page, x, y)});
        const size_t texel = index_of(panorama.grid, {page, x, y});
        const bool is_near = std::abs(panorama.nearness[texel] * seen.depth - 1.0f) < 0.02f;
        right += is_near && length(panorama.colors[texel] - seen.color) < 0.05f ? 1 : 0;
        all++;
      }
    }
  }
  return static_cast<double>(right) / static_cast<double>(all);
}

TEST(DepthPanorama, ShowsTheWorldFromBetweenTheEyes) {
  StereoCamera camera;
  camera.ipd = 0.065f;
  const MadePicture made = picture_of_world(camera, {1024, 512}, {kLeft, kRight});
  const Source source = make_source(made.picture);
  const Reprojection picture = make_reprojection(source);
  EXPECT_GT(share_right(look_from_middle(picture, PageGrid(264, 1), kReach)), 0.985);
}

TEST(DepthPanorama, OfOneEyeIsExactButForEdges) {
  const MadePicture made = picture_of_world(StereoCamera(), {1024, 512}, {kMono});
  const Source source = make_source(made.picture);
  const Reprojection picture = make_reprojection(source);
  EXPECT_GT(share_right(look_from_middle(picture, PageGrid(264, 1), kReach)), 0.995);
}

TEST(DepthPanorama, ShowsNothingBesideAWindow) {
  StereoCamera camera;
  camera.projection.kind = kPerspective;
  const MadePicture made = picture_of_world(camera, {256, 256}, {kMono});
  const Source source = make_source(made.picture);
  const Reprojection picture = make_reprojection(source);
  const PageGrid grid(72, 1);
  const DepthPanorama panorama = look_from_middle(picture, grid, kReach);
  EXPECT_GT(panorama.nearness[index_of(grid, {0, 36, 36})], 0.0f);
  EXPECT_EQ(panorama.nearness[index_of(grid, {2, 36, 36})], kNothing);
}

// The neighbour of a page's last column is the first column of the next face, in the same row.
TEST(DepthPanorama, FindsTexelsBeyondAPage) {
  const PageGrid grid(72, 1);
  const int last = 72 - PageGrid::kGutter - 1;
  EXPECT_EQ(inner_texel(grid, 0, vec2(last, 30) + 0.5f), index_of(grid, {0, last, 30}));
  EXPECT_EQ(inner_texel(grid, 0, vec2(last + 1, 30) + 0.5f), index_of(grid, {1, PageGrid::kGutter, 30}));
}

TEST(DepthPanorama, TellsSlopesFromEdges) {
  const float pixel = 0.001f;
  EXPECT_TRUE(shows_one_surface(0.5f, 0.503f, kReach, pixel));
  EXPECT_FALSE(shows_one_surface(0.5f, 0.6f, kReach, pixel));
  EXPECT_FALSE(shows_one_surface(0.5f, 0.0f, kReach, pixel));
  EXPECT_TRUE(continues(0.4f, 0.5f, 0.6f, kNothing, kReach, pixel));
  EXPECT_TRUE(continues(0.0f, 0.5f, 0.6f, 0.7f, kReach, pixel));
  EXPECT_FALSE(continues(0.5f, 0.5f, 0.6f, 0.6f, kReach, pixel));
  EXPECT_FALSE(continues(0.5f, 0.5f, 0.0f, 0.0f, kReach, pixel));
}

}  // namespace ods::depth_panorama_test
