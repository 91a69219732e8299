// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The errors that ods/kernel/camera/angles.h states, over dense samples against double precision.
#include "ods/kernel/camera/angles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ods {
namespace {

double relative_error(double found, double wanted) {
  return wanted == 0.0 ? std::abs(found) : std::abs(found / wanted - 1.0);
}

TEST(Angles, CosineAndSineAreThoseOfDoublePrecision) {
  constexpr int kSteps = 2000003;
  double worst = 0.0;
  for (int i = 0; i <= kSteps; i++) {
    const float angle = 1000.0f * (2.0f * static_cast<float>(i) / kSteps - 1.0f);
    const vec2 found = cos_sin(angle);
    worst = std::max({worst, std::abs(double{found.x} - std::cos(double{angle})),
                      std::abs(double{found.y} - std::sin(double{angle}))});
    EXPECT_EQ(cos_of(angle), found.x);
    EXPECT_EQ(sin_of(angle), found.y);
  }
  EXPECT_LE(worst, 1e-7);
}

// Near a zero of the sine, too: a picture's rows at its poles depend on it.
TEST(Angles, SineAndTangentKeepTheirPrecisionNearZero) {
  double worst = 0.0;
  for (float angle = 1e-20f; angle < 0.8f; angle *= 1.0001f) {
    for (const float signed_angle : {angle, -angle}) {
      worst = std::max({worst, relative_error(sin_of(signed_angle), std::sin(double{signed_angle})),
                        relative_error(tan_of(signed_angle), std::tan(double{signed_angle}))});
    }
    const float other_pole = kPi - angle;
    worst = std::max(worst, relative_error(sin_of(other_pole), std::sin(double{other_pole})));
  }
  EXPECT_LE(worst, 2.5e-7);
}

TEST(Angles, ArcTangentIsThatOfDoublePrecision) {
  constexpr int kSteps = 400000;
  double worst = 0.0;
  for (int i = 0; i <= kSteps; i++) {
    const double turn = 2.0 * 3.141592653589793 * i / kSteps;
    for (const double length : {1e-30, 1e-3, 1.0, 1e30}) {
      const auto x = static_cast<float>(length * std::cos(turn)), y = static_cast<float>(length * std::sin(turn));
      worst = std::max(worst, relative_error(atan_of(y, x), std::atan2(double{y}, double{x})));
    }
  }
  for (float slope = 1e-30f; slope < 1e30f; slope *= 1.001f) {
    worst = std::max(worst, relative_error(atan_of(-slope, 1.0f), std::atan2(-double{slope}, 1.0)));
  }
  EXPECT_LE(worst, 2e-7);
}

TEST(Angles, ArcTangentOnTheAxes) {
  EXPECT_EQ(atan_of(0.0f, 0.0f), 0.0f);
  EXPECT_EQ(atan_of(0.0f, 1.0f), 0.0f);
  EXPECT_EQ(atan_of(0.0f, -1.0f), kPi);
  EXPECT_EQ(atan_of(1.0f, 0.0f), 0.5f * kPi);
  EXPECT_EQ(atan_of(-1.0f, 0.0f), -0.5f * kPi);
  EXPECT_EQ(atan_of(1.0f, 1.0f), 0.25f * kPi);
}

TEST(Angles, ArcSineIsThatOfDoublePrecision) {
  constexpr int kSteps = 1000003;
  double worst = 0.0;
  for (int i = 0; i <= kSteps; i++) {
    const float x = 2.0f * static_cast<float>(i) / kSteps - 1.0f;
    worst = std::max(worst, relative_error(asin_of(x), std::asin(double{x})));
  }
  for (float x = 1.0f; x > 1e-30f; x *= 0.999f) {
    worst = std::max(worst, relative_error(asin_of(-x), -std::asin(double{x})));
  }
  EXPECT_LE(worst, 3e-7);
}

}  // namespace
}  // namespace ods
