// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/depth/floor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "ods/base/median.h"
#include "ods/camera/pixel.h"
#include "ods/kernel/random.h"
#include "ods/picture/picture.h"

namespace ods {

namespace {

constexpr int kColumns = 256, kRows = 128;  // grid of examined pixels

struct Look {
  vec3 direction;  // unit length; 0 if nothing is visible there
  float nearness = 0.0f;
  float weight = 0.0f;  // solid angle
};

// An evenly spaced selection of pixels, row by row.
std::vector<Look> sampled_looks(const Image& nearness, const Camera& camera, int eye) {
  std::vector<Look> looks;
  for (int row = 0; row < kRows; row++) {
    for (int column = 0; column < kColumns; column++) {
      const int x = (2 * column + 1) * nearness.width / (2 * kColumns),
                y = (2 * row + 1) * nearness.height / (2 * kRows);
      const vec2 uv = pixel_middle(x, y, nearness);
      const vec3 direction = camera_ray(camera, eye, uv).direction;
      looks.push_back({direction, *nearness.at(x, y), relative_solid_angle(camera.projection, uv, uv)});
    }
  }
  return looks;
}

struct Plane {
  vec3 normal{0.0f, 1.0f, 0.0f};
  float height = 0.0f;  // below the viewer
};

// The plane through three points, if it is nearly level and below the viewer.
std::optional<Plane> plane_through(vec3 a, vec3 b, vec3 c) {
  constexpr float kLevel = 0.99f;  // cosine of 8 degrees
  vec3 normal = cross(b - a, c - a);
  const float size = length(normal);
  if (!(size > 1e-12f)) return std::nullopt;
  normal = normal * ((normal.y < 0.0f ? -1.0f : 1.0f) / size);
  const float height = -dot(normal, a);
  if (normal.y < kLevel || !(height > 0.0f)) return std::nullopt;
  return Plane{normal, height};
}

}  // namespace

std::optional<double> floor_below(const Image& nearness, const Camera& camera, int eye) {
  constexpr float kBelow = -0.34f;  // sine of -20 degrees
  constexpr float kThick = 0.03f;   // relative to the height
  constexpr int kRounds = 2000;
  constexpr double kShare = 0.33;
  std::vector<vec3> points;
  std::vector<float> weights;
  double all = 0.0;
  for (const Look& look : sampled_looks(nearness, camera, eye)) {
    if (look.direction.y > kBelow) continue;
    all += double{look.weight};
    if (look.nearness <= 0.0f) continue;
    points.push_back(look.direction * (1.0f / look.nearness)), weights.push_back(look.weight);
  }
  if (points.size() < 50) return std::nullopt;
  Plane best;
  double maximum = 0.0;
  uint32_t picks = 0;
  const auto pick = [&] { return points[hash(picks++) % points.size()]; };
  for (int round = 0; round < kRounds; round++) {
    const vec3 a = pick(), b = pick(), c = pick();
    const std::optional<Plane> plane = plane_through(a, b, c);
    if (!plane) continue;
    double held = 0.0;
    for (size_t i = 0; i < points.size(); i++) {
      const float off = dot(plane->normal, points[i]) + plane->height;
      if (std::abs(off) < kThick * plane->height) held += double{weights[i]};
    }
    if (held > maximum) maximum = held, best = *plane;
  }
  if (maximum < kShare * all) return std::nullopt;
  std::vector<float> heights;  // distances below the viewer, along the normal, of the points on the plane
  for (const vec3 point : points) {
    const float height = -dot(best.normal, point);
    if (std::abs(height - best.height) < kThick * best.height) heights.push_back(height);
  }
  return double{median(heights)};
}

// The median distance of the surfaces between two elevations, given by their sines; negative if nothing is visible
// there.
static float middle_of(const std::vector<Look>& looks, float from, float to) {
  std::vector<float> found;
  for (const Look& look : looks) {
    const bool is_seen = look.direction != vec3(0.0f);
    if (is_seen && look.direction.y >= from && look.direction.y <= to) found.push_back(look.nearness);
  }
  return found.size() < 50 ? -1.0f : median(std::move(found));
}

bool looks_inverted(const Image& nearness, const Camera& camera, int eye) {
  const std::vector<Look> looks = sampled_looks(nearness, camera, eye);
  const float below = middle_of(looks, -1.0f, -0.8f), level = middle_of(looks, -0.15f, 0.15f);
  const float above = middle_of(looks, 0.6f, 1.0f);
  if (below < 0.0f || level < 0.0f) return false;
  int behind = 0, ahead = 0;  // edges at which the lower side is farther, and closer
  for (int row = 0; row + 1 < kRows; row++) {
    for (int column = 0; column < kColumns; column++) {
      const Look& upper = looks[static_cast<size_t>(row * kColumns + column)];
      const Look& lower = looks[static_cast<size_t>((row + 1) * kColumns + column)];
      if (upper.direction == vec3(0.0f) || lower.direction == vec3(0.0f)) continue;
      if (is_one_surface(upper.nearness, lower.nearness)) continue;
      (lower.nearness < upper.nearness ? behind : ahead)++;
    }
  }
  const bool has_far_sky = above >= 0.0f && above < 0.5f * std::min(below, level);
  return below < 0.9f * level && !has_far_sky && behind > 2 * ahead;
}

}  // namespace ods
