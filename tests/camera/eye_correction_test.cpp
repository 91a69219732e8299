// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/eye_correction.h"

#include <gtest/gtest.h>

namespace ods::eye_correction_test {

vec3 toward(double theta, double phi) {
  const double t = glm::radians(theta), p = glm::radians(phi);
  return vec3(glm::dvec3(std::sin(t) * std::cos(p), std::sin(p), -std::cos(t) * std::cos(p)));
}

void expect_near(vec3 found, vec3 expected) {
  EXPECT_LT(length(found - expected), 1e-6f) << found.x << " " << found.y << " " << found.z;
}

EyeCorrection correction(float EyeCorrection::*field, float value) {
  EyeCorrection made;
  made.*field = value;
  return made;
}

TEST(EyeCorrection, NoneLeavesEverythingWhereItIs) {
  for (const double theta : {-170.0, 0.0, 35.0, 180.0}) {
    expect_near(stored_direction({}, toward(theta, 20.0)), toward(theta, 20.0));
  }
  EXPECT_FALSE(moves_pixels({}));
  EXPECT_FALSE(changes_colors({}));
  EXPECT_EQ(corrected_color({}, vec3(0.2f, 0.5f, 3.0f)), vec3(0.2f, 0.5f, 3.0f));
}

// The rotation of a camera that is turned to the right, up and clockwise.
TEST(EyeCorrection, TurnsAsACameraDoes) {
  expect_near(stored_direction(correction(&EyeCorrection::yaw, 30.0f), toward(10.0, 0.0)), toward(40.0, 0.0));
  expect_near(stored_direction(correction(&EyeCorrection::pitch, 10.0f), toward(0.0, 0.0)), toward(0.0, 10.0));
  expect_near(stored_direction(correction(&EyeCorrection::pitch, 10.0f), toward(180.0, 0.0)), toward(180.0, -10.0));
  expect_near(stored_direction(correction(&EyeCorrection::pitch, 10.0f), toward(90.0, 0.0)), toward(90.0, 0.0));
  expect_near(stored_direction(correction(&EyeCorrection::roll, 5.0f), toward(90.0, 0.0)), toward(90.0, -5.0));
  expect_near(stored_direction(correction(&EyeCorrection::roll, 5.0f), toward(-90.0, 0.0)), toward(-90.0, 5.0));
}

TEST(EyeCorrection, RaisesAllDirectionsAlike) {
  for (const double theta : {0.0, 90.0, 180.0, -120.0}) {
    expect_near(stored_direction(correction(&EyeCorrection::raise, 3.0f), toward(theta, 0.0)), toward(theta, -3.0));
    expect_near(stored_direction(correction(&EyeCorrection::raise, 3.0f), toward(theta, 40.0)), toward(theta, 37.0));
  }
  // Over the lower pole it continues on the other side.
  expect_near(stored_direction(correction(&EyeCorrection::raise, 3.0f), toward(20.0, -89.0)), toward(-160.0, -88.0));
}

TEST(EyeCorrection, EnlargesAboutTheMiddle) {
  const EyeCorrection twice = correction(&EyeCorrection::zoom, 2.0f);
  expect_near(stored_direction(twice, toward(0.0, 0.0)), toward(0.0, 0.0));
  expect_near(stored_direction(twice, toward(40.0, -30.0)), toward(20.0, -15.0));
}

TEST(EyeCorrection, RaisesLightToAPowerAndThenMultipliesIt) {
  EyeCorrection both;
  both.gamma = 2.0f;
  both.gain = vec3(1.0f, 2.0f, 0.5f);
  const vec3 made = corrected_color(both, vec3(0.5f, 0.5f, 2.0f));
  EXPECT_FLOAT_EQ(made.x, 0.25f);
  EXPECT_FLOAT_EQ(made.y, 0.5f);
  EXPECT_FLOAT_EQ(made.z, 2.0f);
  EXPECT_TRUE(changes_colors(both));
  EXPECT_FALSE(moves_pixels(both));
}

}  // namespace ods::eye_correction_test
