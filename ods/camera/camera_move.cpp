// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/camera_move.h"

#include <algorithm>
#include <cmath>

#include "ods/camera/camera_fields.h"

namespace ods {

using glm::dvec3;

namespace {

// Interpolates between p[1] and p[2]; t[i] are the knots of p[i].
// Source: Barry and Goldman, "A recursive evaluation algorithm for a class of Catmull-Rom splines", 1988.
dvec3 catmull_rom(const dvec3 p[4], const double t[4], double at) {
  const auto between = [&](const dvec3& a, const dvec3& b, double from, double to) {
    return to > from ? ((to - at) * a + (at - from) * b) / (to - from) : a;
  };
  const dvec3 a = between(p[0], p[1], t[0], t[1]), b = between(p[1], p[2], t[1], t[2]);
  const dvec3 c = between(p[2], p[3], t[2], t[3]);
  return between(between(a, b, t[0], t[2]), between(b, c, t[1], t[3]), t[1], t[2]);
}

// Points of the curve, dense enough for the chords between them to replace it.
std::vector<dvec3> flight(const dvec3& start, const std::vector<vec3>& places) {
  constexpr int kSteps = 256;
  std::vector<dvec3> p = {start};
  for (const vec3& place : places) {
    if (dvec3(place) != p.back()) p.emplace_back(place);
  }
  if (p.size() == 1) return p;
  p.insert(p.begin(), 2.0 * p[0] - p[1]);  // so that the curve starts and ends straight
  p.push_back(2.0 * p[p.size() - 1] - p[p.size() - 2]);
  std::vector<double> knots = {0.0};
  for (size_t i = 1; i < p.size(); i++) knots.push_back(knots.back() + glm::distance(p[i - 1], p[i]));
  std::vector<dvec3> curve = {start};
  for (size_t i = 1; i + 2 < p.size(); i++) {
    for (int step = 1; step <= kSteps; step++) {
      const double share = static_cast<double>(step) / kSteps;
      curve.push_back(catmull_rom(&p[i - 1], &knots[i - 1], knots[i] + share * (knots[i + 1] - knots[i])));
    }
  }
  return curve;
}

dvec3 point_along(const std::vector<dvec3>& curve, double share) {
  std::vector<double> lengths = {0.0};
  for (size_t i = 1; i < curve.size(); i++) lengths.push_back(lengths.back() + glm::distance(curve[i - 1], curve[i]));
  const double wanted = share * lengths.back();
  const auto after = std::upper_bound(lengths.begin(), lengths.end(), wanted);
  if (after == lengths.end()) return curve.back();
  const auto i = static_cast<size_t>(after - lengths.begin());
  const double part = (wanted - lengths[i - 1]) / (lengths[i] - lengths[i - 1]);
  return glm::mix(curve[i - 1], curve[i], part);
}

}  // namespace

bool moves(const CameraMove& move) {
  return move.turns != 0.0 || !move.fly_to.empty();
}

StereoCamera moved(const StereoCamera& camera, const CameraMove& move, double time) {
  StereoCamera result = camera;
  const double share = time / move.seconds;
  if (!move.fly_to.empty()) {
    const double t = std::clamp(share, 0.0, 1.0);
    result.position = vec3(point_along(flight(dvec3(camera.position), move.fly_to), t * t * (3.0 - 2.0 * t)));
  }
  if (move.turns == 0.0) return result;
  const double turns = move.turns * share;
  const double degrees = 360.0 * (turns - std::floor(turns));
  result.yaw = angle_in_range(static_cast<double>(camera.yaw) + degrees);
  if (move.pivot) {
    const double a = glm::radians(degrees), c = std::cos(a), s = std::sin(a);
    const dvec3 pivot(*move.pivot), out = dvec3(result.position) - pivot;
    result.position = vec3(pivot + dvec3(c * out.x - s * out.z, out.y, s * out.x + c * out.z));
  }
  return result;
}

}  // namespace ods
