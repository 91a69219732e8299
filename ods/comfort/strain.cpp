// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/comfort/strain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ods/base/angles.h"

namespace ods {

using std::numbers::pi;

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

double nearest_in_zone(double focus_dioptres) {
  return focus_dioptres / 1.035 + 0.626;
}

StrainLimits near_limits(const Viewer& viewer) {
  const double focus = 1.0 / double{viewer.focus};  // 0 if that is infinite
  const double at_focus = 2.0 * std::atan(0.5 * focus * double{viewer.ipd});
  const double one_degree = vergence_dioptres(at_focus + kDegree, viewer);
  const double zone = nearest_in_zone(focus);
  return {std::min(one_degree, zone), zone, std::max(zone, 1.0 / kGoogleAhead)};
}

}  // namespace

StrainLimits strain_limits(Strain strain, const Viewer& viewer) {
  switch (strain) {
    case Strain::kNear:
      return near_limits(viewer);
    case Strain::kVertical:
      return {15.0, kFusionLimit, 60.0};
    case Strain::kStep:
    case Strain::kEdge:
      return {1.84, 3.05, kNever};
    case Strain::kRule:
      return {1.0, 1.0, 1.0};
  }
  return {};
}

EnumArray<Strain, StrainLimits> strain_limits(const Viewer& viewer) {
  EnumArray<Strain, StrainLimits> limits{};
  for (const Strain strain : kStrains) limits[strain] = strain_limits(strain, viewer);
  return limits;
}

ComfortLevel level_of(double value, const StrainLimits& limits) {
  if (value > limits.error) return ComfortLevel::kError;
  if (value > limits.warning) return ComfortLevel::kWarning;
  return value > limits.caution ? ComfortLevel::kCaution : ComfortLevel::kOk;
}

double gaze_density(double elevation) {
  return std::exp(-std::abs(elevation) / (18.6 * kDegree)) / std::max(std::cos(elevation), 1e-3);
}

CircleView seen_from_circle(double radius, double across, double height) {
  return {std::asin(radius / across), std::atan2(height, std::sqrt(across * across - radius * radius))};
}

double vergence(double half_parallax, double elevation) {
  return 2.0 * std::asin(std::clamp(std::cos(elevation) * std::sin(half_parallax), -1.0, 1.0));
}

double vergence_dioptres(double vergence, const Viewer& viewer) {
  return 2.0 * std::tan(0.5 * vergence) / double{viewer.ipd};
}

double vertical_disparity(double half_parallax, double elevation, double head_yaw) {
  const double height = std::tan(elevation);
  return std::atan2(height, std::cos(head_yaw + half_parallax)) -
         std::atan2(height, std::cos(head_yaw - half_parallax));
}

HeadReach reach_of(const Viewer& viewer) {
  return {double{viewer.gaze_degrees} * kDegree, double{viewer.roll_degrees} * kDegree};
}

// Vertical disparity is the angle between the eyes' lines of sight about the line h through the ears. Let m be the
// direction in the middle of them, e the one along which they differ, and n = m x e. Then it grows with how much h
// leans from e towards n, and with the angle between h and the plane of e and n. Gaze bounds that angle, the roll how
// much h leans: its height is that lean times the elevation's cosine plus the angle's sine times the elevation's sine.
double worst_vertical_disparity(double half_parallax, double elevation, const HeadReach& reach) {
  const double converged = vergence(half_parallax, elevation);
  const double middle = std::atan2(std::abs(std::sin(elevation)), std::cos(elevation) * std::cos(half_parallax));
  const double aside = std::min(reach.gaze, 0.5 * pi + reach.roll - middle);
  const double across = std::cos(aside) * std::cos(middle);
  const double maximum = std::sin(reach.roll) + std::sin(middle) * std::sin(aside);
  const double lean = maximum < across ? maximum / across : 1.0;  // the sine
  const double inside = std::cos(aside) * std::cos(aside), along = inside * (1.0 - lean * lean);
  const double together = 0.5 * (1.0 + std::cos(converged)), apart = 0.5 * (1.0 - std::cos(converged));
  return std::atan2(std::abs(std::sin(converged)) * std::cos(aside) * lean, together * inside - apart * (1.0 - along));
}

double roll_for_disparity(double half_parallax, double elevation, double gaze, double limit) {
  double minimum = 0.0, maximum = 0.5 * pi;
  if (worst_vertical_disparity(half_parallax, elevation, {gaze, maximum}) <= limit) return maximum;
  if (worst_vertical_disparity(half_parallax, elevation, {gaze, minimum}) >= limit) return 0.0;
  for (int i = 0; i < 20; i++) {
    const double roll = 0.5 * (minimum + maximum);
    (worst_vertical_disparity(half_parallax, elevation, {gaze, roll}) <= limit ? minimum : maximum) = roll;
  }
  return minimum;
}

}  // namespace ods
