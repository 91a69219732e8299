// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Views of waves, of which a part is nearer.
#include "ods/disparity/dense_match.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/camera/projection.h"
#include "tests/support/waves.h"

namespace ods {
namespace {

constexpr float kPixel = 6.2831853f / 512.0f;
constexpr float kFar = 2.3f * kPixel, kNear = 9.6f * kPixel;

bool is_near(float theta, float phi) {
  return std::abs(theta - 0.5f) < 0.25f && std::abs(phi) < 0.2f;
}

// Grey without detail above 40 degrees. Near things hide the things behind them.
GrayView view_of(const Waves& far, const Waves& near, float side) {
  GrayView view(512, 256, 1);
  for (int y = 0; y < 256; y++) {
    for (int x = 0; x < 512; x++) {
      const float theta = kPixel * (static_cast<float>(x) + 0.5f - 256.0f);
      const float phi = kPixel * (128.0f - static_cast<float>(y) - 0.5f);
      const bool hides = is_near(theta + 0.5f * side * kNear, phi);
      const float moved = theta + 0.5f * side * (hides ? kNear : kFar);
      const vec3 d = look_at_angles(moved, phi).direction;
      *view.at(x, y) = phi > 0.7f ? 0.5f : hides ? near(d) : far(d);
    }
  }
  return view;
}

TEST(DenseMatch, FindsWhatIsNearAndWhatIsFarInBothEyes) {
  const Waves far(5), near(9);
  const DenseMatch match = match_densely(view_of(far, near, -1.0f), view_of(far, near, 1.0f));
  for (const int eye : {0, 1}) {
    int right = 0, wrong = 0, flat = 0;
    for (int y = 40; y < 216; y++) {
      for (int x = 0; x < 512; x++) {  // the picture continues beyond its sides
        const float theta = kPixel * (static_cast<float>(x) + 0.5f - 256.0f);
        const float phi = kPixel * (128.0f - static_cast<float>(y) - 0.5f), found = *match.around[eye].at(x, y);
        if (std::isnan(found)) continue;
        const bool hides = is_near(theta + (eye == 0 ? -0.5f : 0.5f) * kNear, phi);
        flat += phi > 0.76f;
        (std::abs(found - (hides ? kNear : kFar)) < 0.5f * kPixel ? right : wrong)++;
      }
    }
    EXPECT_GT(right, 60000);
    EXPECT_LT(wrong, 0.03 * right);
    EXPECT_EQ(flat, 0);
  }
  EXPECT_GT(match.share, 0.6);
  EXPECT_LT(match.share, 0.85);
  EXPECT_LT(match.precision, 0.5f * kPixel);
}

TEST(DenseMatch, WhatIsNotSeenIsUnknown) {
  const Waves far(5), near(9);
  GrayView left = view_of(far, near, -1.0f), right = view_of(far, near, 1.0f);
  for (GrayView* view : {&left, &right}) {
    for (int y = 0; y < 256; y++) {
      for (int x = 0; x < 512; x++) {
        if (x < 128 || x >= 384) *view->at(x, y) = NAN;
      }
    }
  }
  const DenseMatch match = match_densely(left, right);
  EXPECT_TRUE(std::isnan(*match.around[0].at(100, 128)));
  EXPECT_FALSE(std::isnan(*match.around[0].at(256, 128)));
  EXPECT_GT(match.share, 0.5);  // of what is seen
}

}  // namespace
}  // namespace ods
