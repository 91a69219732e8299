// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The closed forms of strain against simulated viewers.
#include "ods/comfort/strain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <random>

#include "ods/base/angles.h"

namespace ods {
namespace {

using glm::dvec3;
using std::numbers::pi;

dvec3 direction(double azimuth, double elevation) {
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), -std::cos(elevation) * std::cos(azimuth)};
}

// How far an eye of that head must turn up to look along a direction, about the line through both eyes.
double eye_pitch(dvec3 look, double yaw, double pitch) {
  const dvec3 ahead = direction(yaw, pitch), up = direction(yaw, pitch + 0.5 * pi);
  return std::atan2(glm::dot(look, up), glm::dot(look, ahead));
}

// A viewer who turns the head in all ways that keep the point within reach of the eyes.
TEST(Strain, NoHeadSeesAWorseVerticalDisparity) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 60; i++) {
    const double half = std::asin(0.0325 / (0.4 + 4.0 * unit(random)));
    const double elevation = (unit(random) - 0.5) * 178.0 * kDegree, gaze = (5.0 + 25.0 * unit(random)) * kDegree;
    const dvec3 left = direction(half, elevation), right = direction(-half, elevation),
                point = direction(0.0, elevation);
    double worst = 0.0;
    for (int turn = 0; turn <= 180; turn++) {
      for (int nod = -180; nod <= 180; nod++) {
        const double yaw = turn * 0.5 * kDegree, pitch = nod * 0.5 * kDegree;
        if (glm::dot(point, direction(yaw, pitch)) < std::cos(gaze)) continue;
        worst = std::max(worst, std::abs(eye_pitch(left, yaw, pitch) - eye_pitch(right, yaw, pitch)));
      }
    }
    const double predicted = worst_vertical_disparity(half, elevation, gaze);
    EXPECT_LE(worst, predicted * (1.0 + 1e-9)) << elevation / kDegree;
    EXPECT_GE(worst, 0.9 * predicted) << elevation / kDegree;
  }
}

// Figures derived in closed form elsewhere, to the digits given there.
TEST(Strain, KnownVerticalDisparities) {
  const auto minutes = [](double metres, double elevation, double gaze) {
    const double across = metres * std::cos(elevation * kDegree);
    return worst_vertical_disparity(std::asin(0.0325 / across), elevation * kDegree, gaze * kDegree) / kArcMinute;
  };
  EXPECT_EQ(minutes(0.6, 0.0, 15.0), 0.0);  // at the horizon itself eyes never turn apart
  EXPECT_NEAR(minutes(1.0, 60.0, 15.0), 107.3, 0.6);
  EXPECT_NEAR(minutes(2.5, 80.0, 15.0), 90.6, 0.6);
  EXPECT_NEAR(minutes(3.5, 89.0, 15.0), 63.8, 0.1);  // Google's rule above and below: a degree
}

TEST(Strain, VergenceIsThatOfTheDistance) {
  const Viewer viewer;
  for (const double elevation : {0.0, 40.0, -70.0}) {
    for (const double metres : {0.5, 1.0, 20.0}) {
      const double across = metres * std::cos(elevation * kDegree), radius = 0.5 * double{viewer.ipd};
      // The eyes of a head that looks at the point are as far apart as those of the circle, seen from there.
      const double angle = vergence(std::asin(radius / across), elevation * kDegree);
      EXPECT_NEAR(vergence_dioptres(angle, viewer), 1.0 / metres, 4e-3 / metres);
    }
  }
}

TEST(Strain, LimitsRise) {
  for (const float focus : {0.5f, 1.0f, 1.3f, 2.0f, std::numeric_limits<float>::infinity()}) {
    const Viewer viewer{0.065f, focus};
    for (const Strain strain : kStrains) {
      const StrainLimits limits = strain_limits(strain, viewer);
      EXPECT_LE(limits.caution, limits.warning) << focus << strain_row(strain).name;
      EXPECT_LE(limits.warning, limits.error) << focus << strain_row(strain).name;
      EXPECT_EQ(level_of(0.0, limits), ComfortLevel::kOk);
      EXPECT_EQ(level_of(limits.caution * 1.0001, limits) >= ComfortLevel::kCaution, true);
    }
  }
  // A headset that focuses at 1.3 m: 0.96 m by the rule of one degree, 0.73 m by the zone of comfort.
  const StrainLimits near = strain_limits(Strain::kNear, Viewer{});
  EXPECT_NEAR(1.0 / near.caution, 0.96, 0.01);
  EXPECT_NEAR(1.0 / near.warning, 0.73, 0.01);
  EXPECT_NEAR(1.0 / near.error, 0.60, 0.001);
}

}  // namespace
}  // namespace ods
