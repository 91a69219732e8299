// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/stereo_camera.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ods {
namespace {

TEST(StereoCamera, AMapThatIsACurveIsTheSameAround) {
  EXPECT_TRUE(merges_same_around(make_camera({})));
  Image map(4, 3, 1);
  for (int y = 0; y < map.height; y++) std::fill_n(map.at(0, y), map.width, 0.25f * static_cast<float>(y));
  EXPECT_TRUE(is_same_around(map));
  for (int y = 0; y < map.height; y++) {
    for (int x = 0; x < map.width; x++) {
      Image other = map;
      *other.at(x, y) += 0.1f;
      EXPECT_FALSE(is_same_around(other)) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace ods
