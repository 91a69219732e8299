// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Measures the eyes of a hall's pictures, which come without camera metadata.
#include "ods/comfort/measured_eyes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/hall.h"

namespace ods {
namespace {

constexpr Extent kSize{1024, 512};

std::optional<MeasuredEyes> measured(const StereoCamera& camera) {
  const std::vector<Image> eyes = {grey_of(seen_in(World::kHall, camera, kLeft, kSize)),
                                   grey_of(seen_in(World::kHall, camera, kRight, kSize))};
  return measure_eyes(eyes, {StereoCamera(), kLeft, hall_depth(camera, kLeft, kSize), {}, {}}, false);
}

// Cycles' merge from 60 to 75 degrees, and ours.
TEST(MeasuredEyes, APoleMergeIsFound) {
  for (const PoleMergeSetting& merge : {PoleMergeSetting{kMergeCosine, 60.0f, 75.0f, 1.0f}, kUsualMerge}) {
    StereoCamera camera;
    camera.top = camera.bottom = merge;
    const std::optional<MeasuredEyes> found = measured(camera);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->is_known && found->is_merged);
    EXPECT_EQ(found->camera.ipd, camera.ipd);
    const Camera truth = make_camera(camera), own = make_camera(found->camera);
    for (float elevation = -85.0f; elevation <= 85.0f; elevation += 5.0f) {
      const float phi = elevation * 3.14159265f / 180.0f;
      const vec3 direction(0.0f, std::sin(phi), -std::cos(phi));
      const float off = std::abs(elevation) > 75.0f ? 0.2f : 0.08f;  // beyond 78 degrees nothing is matched
      EXPECT_NEAR(merge_at(own, direction, phi), merge_at(truth, direction, phi), off) << merge.end << " " << elevation;
    }
  }
}

TEST(MeasuredEyes, NoMergeIsFoundWhereThereIsNone) {
  StereoCamera parallel, wide, converged;
  wide.ipd = 0.1f;
  converged.convergence = kToeIn, converged.convergence_distance = 1.95f;  // Blender's defaults
  for (const StereoCamera& camera : {parallel, wide, converged}) {
    const std::optional<MeasuredEyes> found = measured(camera);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->is_known, camera.convergence == kParallel);
    EXPECT_FALSE(found->is_merged);
    EXPECT_NEAR(found->camera.ipd, camera.ipd, 0.04f * camera.ipd);
    EXPECT_EQ(found->camera.convergence, camera.convergence);
    EXPECT_NEAR(found->camera.convergence_distance, camera.convergence_distance, 0.1f);
  }
}

TEST(MeasuredEyes, EyesThatDoNotMatchTellNothing) {
  const StereoCamera camera;
  const std::vector<Image> eyes = {grey_of(seen_in(World::kHall, camera, kLeft, kSize)),
                                   grey_of(seen_in(World::kCave, camera, kRight, kSize))};
  EXPECT_FALSE(measure_eyes(eyes, {camera, kLeft, hall_depth(camera, kLeft, kSize), {}, {}}, false));
}

}  // namespace
}  // namespace ods
