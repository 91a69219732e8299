// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Each interpolation against its formula in glTF 2.0, appendix C.
#include "ods/scene/keyframes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/scene/animation.h"

namespace ods {
namespace {

std::vector<double> at(const Keyframes& keys, double seconds) {
  std::vector<double> out(keys.width);
  evaluate(keys, seconds, out);
  return out;
}

TEST(Keyframes, StepTakesTheKeyBefore) {
  const Keyframes keys{Interpolation::kStep, false, 1, {1.0f, 2.0f, 4.0f}, {10.0f, 20.0f, 30.0f}};
  const std::pair<double, double> known[] = {{-1.0, 10.0}, {1.0, 10.0}, {1.99, 10.0}, {2.0, 20.0},
                                             {3.9, 20.0},  {4.0, 30.0}, {99.0, 30.0}};
  for (const auto& [time, value] : known) EXPECT_EQ(at(keys, time)[0], value) << time;
}

TEST(Keyframes, LinearIsStraightAndStandsStillOutside) {
  const Keyframes keys{Interpolation::kLinear, false, 2, {1.0f, 2.0f, 4.0f}, {0, 8, 10, 4, 30, 0}};
  for (const double t : {1.0, 1.25, 1.5, 1.999}) {
    EXPECT_NEAR(at(keys, t)[0], 10.0 * (t - 1.0), 1e-12);
    EXPECT_NEAR(at(keys, t)[1], 8.0 - 4.0 * (t - 1.0), 1e-12);
  }
  EXPECT_NEAR(at(keys, 3.0)[0], 20.0, 1e-12);
  EXPECT_EQ(at(keys, 0.0), (std::vector<double>{0.0, 8.0}));
  EXPECT_EQ(at(keys, 4.0), (std::vector<double>{30.0, 0.0}));
  EXPECT_EQ(at(keys, 5.0), (std::vector<double>{30.0, 0.0}));
}

// A curve of the third degree is its own Hermite spline: keys of p(t) = t^3 - 2 t^2 + 3 with its derivative.
TEST(Keyframes, CubicSplineIsExactForACubic) {
  const auto p = [](double t) { return t * t * t - 2.0 * t * t + 3.0; };
  const auto slope = [](double t) { return 3.0 * t * t - 4.0 * t; };
  Keyframes keys{Interpolation::kCubicSpline, false, 1, {0.5f, 1.0f, 3.0f}, {}};
  for (const float key : keys.times) {
    const double t = static_cast<double>(key);
    for (const double value : {slope(t), p(t), slope(t)}) keys.values.push_back(static_cast<float>(value));
  }
  for (double t = 0.5; t <= 3.0; t += 0.125) EXPECT_NEAR(at(keys, t)[0], p(t), 1e-6) << t;
  EXPECT_NEAR(at(keys, 0.0)[0], p(0.5), 1e-6);
  EXPECT_NEAR(at(keys, 9.0)[0], p(3.0), 1e-6);
}

TEST(Keyframes, RotationsTurnAtConstantSpeedTheShorterWay) {
  const double pi = std::acos(-1.0);
  const auto about_y = [](double angle) { return std::vector<double>{0, std::sin(angle / 2), 0, std::cos(angle / 2)}; };
  for (const double sign : {1.0, -1.0}) {  // q and -q are the same rotation
    Keyframes keys{Interpolation::kLinear, true, 4, {0.0f, 1.0f}, {}};
    for (const double part : about_y(0.0)) keys.values.push_back(static_cast<float>(part));
    for (const double part : about_y(2.5)) keys.values.push_back(static_cast<float>(sign * part));
    for (const double t : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      const std::vector<double> q = at(keys, t), known = about_y(2.5 * t);
      const double same = q[1] * known[1] < 0.0 || q[3] * known[3] < 0.0 ? -1.0 : 1.0;
      for (size_t i = 0; i < 4; i++) EXPECT_NEAR(same * q[i], known[i], 1e-7) << t;
    }
  }
  // Keys that are the same, or nearly so, have no axis to turn about.
  const float tiny = 1e-7f;
  const Keyframes same{Interpolation::kLinear, true, 4, {0.0f, 1.0f}, {0, 0, 0, 1, tiny, 0, 0, 1}};
  EXPECT_NEAR(at(same, 0.5)[3], 1.0, 1e-12);
  EXPECT_LT(at(same, 0.5)[0], pi * 1e-7);
}

TEST(Keyframes, CubicRotationsHaveUnitLength) {
  const Keyframes keys{Interpolation::kCubicSpline, true, 4, {0.0f, 1.0f}, {0, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0,
                                                                            0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}};
  for (const double t : {0.0, 0.3, 0.5, 1.0}) {
    const std::vector<double> q = at(keys, t);
    // x: out-tangent 1 leads away, in-tangent 0 comes back; y and w: value 0 -> 1 and 1 -> 0, y with in-tangent 1.
    const double t2 = t * t, t3 = t2 * t;
    const double raw[4] = {t3 - 2 * t2 + t, 3 * t2 - 2 * t3 + (0.0) * t, 0.0, 2 * t3 - 3 * t2 + 1};
    const double in = t3 - t2;  // weight of the in-tangent of the second key
    const double expected[4] = {raw[0] + 0.0 * in, raw[1] + 1.0 * in, 0.0, raw[3]};
    double size = 0.0, known = 0.0;
    for (size_t i = 0; i < 4; i++) size += q[i] * q[i], known += expected[i] * expected[i];
    EXPECT_NEAR(size, 1.0, 1e-12);
    for (size_t i = 0; i < 4; i++) EXPECT_NEAR(q[i], expected[i] / std::sqrt(known), 1e-7) << t << " " << i;
  }
}

TEST(Keyframes, EqualTimesAreAJump) {
  const Keyframes keys{Interpolation::kLinear, false, 1, {0.0f, 1.0f, 1.0f, 2.0f}, {0, 1, 5, 6}};
  EXPECT_NEAR(at(keys, 0.999999)[0], 0.999999, 1e-9);
  EXPECT_EQ(at(keys, 1.0)[0], 5.0);
  EXPECT_EQ(at(keys, 1.5)[0], 5.5);
}

TEST(Keyframes, EveryPropertyHasAWidth) {
  for (const Property property : kProperties) {
    EXPECT_LE(property_width(property), 4u);
    EXPECT_EQ(property_width(property) == 0, property == Property::kWeights);
  }
}

}  // namespace
}  // namespace ods
