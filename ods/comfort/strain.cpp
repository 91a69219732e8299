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

// The yaw up to which a head may be turned away from the point.
double most_yaw(double elevation, double gaze) {
  return std::asin(std::min(std::sin(gaze) / std::max(std::cos(elevation), 1e-12), 1.0));
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

ComfortLevel level_of(double value, const StrainLimits& limits) {
  if (value > limits.error) return ComfortLevel::kError;
  if (value > limits.warning) return ComfortLevel::kWarning;
  return value > limits.caution ? ComfortLevel::kCaution : ComfortLevel::kOk;
}

double looked_at(double elevation) {
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

// |V| grows with the yaw up to a quarter turn. From a head turned by beta the point is at least
// asin(cos phi sin beta) from straight ahead.
double worst_vertical_disparity(double half_parallax, double elevation, double gaze) {
  return std::abs(vertical_disparity(half_parallax, elevation, most_yaw(elevation, gaze)));
}

}  // namespace ods
