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

// The angle by which an eye must turn up, about the line through both eyes, to look along a direction, minus the other
// eye's angle.
double apart(dvec3 left, dvec3 right, dvec3 ears) {
  const auto across = [&](dvec3 look) { return look - glm::dot(look, ears) * ears; };
  const dvec3 a = across(left), b = across(right);
  return std::abs(std::atan2(glm::dot(glm::cross(a, b), ears), glm::dot(a, b)));
}

// A viewer who turns, nods and tilts the head in 10,000 ways that keep the point within reach of the eyes, and then
// looks around the worst one for a worse one.
double worst_of_heads(dvec3 left, dvec3 right, const HeadReach& reach, std::mt19937& random) {
  const dvec3 point = glm::normalize(left + right);
  const double azimuth = std::atan2(point.x, -point.z), elevation = std::asin(point.y);
  dvec3 best(azimuth, elevation, 0.0);  // yaw, pitch, roll
  double worst = 0.0;
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 10'000; i++) {
    const double wide = i < 5000 ? 1.0 : std::exp(-i / 900.0 + 5.0);
    const dvec3 middle = i < 5000 ? dvec3(azimuth, elevation, 0.0) : best;
    dvec3 head = middle + wide * dvec3(pi * unit(random), 0.5 * pi * unit(random), 0.5 * pi * unit(random));
    head.y = std::clamp(head.y, -0.5 * pi, 0.5 * pi);
    const dvec3 ahead = direction(head.x, head.y), level = direction(head.x + 0.5 * pi, 0.0);
    const dvec3 ears = std::cos(head.z) * level + std::sin(head.z) * glm::cross(level, ahead);
    if (glm::dot(point, ahead) < std::cos(reach.gaze) || std::abs(ears.y) > std::sin(reach.roll) + 1e-12) {
      head.z = 0.0;  // level ears are always within reach
      if (glm::dot(point, ahead) < std::cos(reach.gaze) || apart(left, right, level) <= worst) continue;
      best = head, worst = apart(left, right, level);
    } else if (const double value = apart(left, right, ears); value > worst) {
      best = head, worst = value;
    }
  }
  return worst;
}

TEST(Strain, NoHeadSeesAWorseVerticalDisparity) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 120; i++) {
    const double half = std::asin(0.0325 / (0.4 + 4.0 * unit(random)));
    const double elevation = (unit(random) - 0.5) * 178.0 * kDegree;
    const HeadReach reach{(5.0 + 25.0 * unit(random)) * kDegree, i % 2 == 0 ? 0.0 : 20.0 * unit(random) * kDegree};
    const double worst = worst_of_heads(direction(half, elevation), direction(-half, elevation), reach, random);
    const double predicted = worst_vertical_disparity(half, elevation, reach);
    EXPECT_LE(worst, predicted * (1.0 + 1e-9)) << elevation / kDegree;
    EXPECT_GE(worst, 0.9 * predicted) << elevation / kDegree << " " << reach.roll / kDegree;
  }
}

// While one looks straight at a point, roll alone tilts the vergence.
TEST(Strain, RollTiltsTheVergence) {
  for (const double elevation : {0.0, 30.0, -50.0}) {
    const double half = std::asin(0.0325 / 1.0), roll = 10.0 * kDegree;
    const double converged = vergence(half, elevation * kDegree);
    const double found = worst_vertical_disparity(half, elevation * kDegree, {0.0, roll});
    EXPECT_NEAR(found, converged * std::min(std::sin(roll) / std::cos(elevation * kDegree), 1.0), 2e-3 * converged);
  }
  // 10 degrees at 1 m, straight ahead.
  EXPECT_NEAR(worst_vertical_disparity(std::asin(0.0325), 0.0, {0.0, 10.0 * kDegree}) / kArcMinute, 38.8, 0.1);
}

TEST(Strain, TheRollForADisparityGivesIt) {
  const double gaze = 15.0 * kDegree, limit = kFusionLimit * kArcMinute;
  for (const double elevation : {0.0, 20.0, -40.0}) {
    const double half = std::asin(0.0325 / 2.5);
    const double roll = roll_for_disparity(half, elevation * kDegree, gaze, limit);
    EXPECT_GT(roll, 0.0) << elevation;
    EXPECT_NEAR(worst_vertical_disparity(half, elevation * kDegree, {gaze, roll}), limit, 1e-3 * limit) << elevation;
  }
  EXPECT_EQ(roll_for_disparity(std::asin(0.0325), 80.0 * kDegree, gaze, limit), 0.0);  // too much already
  EXPECT_EQ(roll_for_disparity(1e-4, 0.0, gaze, limit), 0.5 * pi);                     // never too much
}

// Figures derived in closed form elsewhere, to the digits given there.
TEST(Strain, KnownVerticalDisparities) {
  const auto minutes = [](double metres, double elevation, double gaze) {
    const double across = metres * std::cos(elevation * kDegree);
    return worst_vertical_disparity(std::asin(0.0325 / across), elevation * kDegree, {gaze * kDegree, 0.0}) /
           kArcMinute;
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
      // Seen from the point, the eyes of a head that looks at it are as far apart as the eyes of the circle.
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
