// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/light/lamp.h"

#include <algorithm>
#include <cmath>

#include "ods/kernel/camera/camera.h"
#include "ods/kernel/surface.h"
#include "ods/scene/builtin/builder.h"

namespace ods {
namespace {

constexpr vec3 kUp(0.0f, 1.0f, 0.0f);
constexpr int kAround = 32;
constexpr float kDrop = 0.04f;     // below the ceiling, relative to the room's height
constexpr float kSize = 0.1f;      // radius, relative to the height above the floor
constexpr float kFloor = 0.4f;     // radiance of a white floor below
constexpr float kFarthest = 1e4f;  // metres: maximum distance of a wall that counts

vec3 around(int i) {
  const float angle = 2.0f * kPi * (static_cast<float>(i) + 0.5f) / kAround;
  return {cos(angle), 0.0f, sin(angle)};
}

// The distances to the walls, at this height.
std::vector<float> walls_around(vec3 place, const Clearance& clearance) {
  std::vector<float> distances;
  for (int i = 0; i < kAround; i++) distances.push_back(std::min(clearance(place, around(i)), kFarthest));
  return distances;
}

float nearest_wall(vec3 place, const Clearance& clearance) {
  return std::ranges::min(walls_around(place, clearance));
}

// The vector from a place to the middle of the space that is visible from there at its height.
vec3 to_middle(vec3 place, const Clearance& clearance) {
  const std::vector<float> walls = walls_around(place, clearance);
  vec3 sum(0.0f);
  float area = 0.0f;
  for (int i = 0; i < kAround; i++) {
    const float r = walls[static_cast<size_t>(i)];
    sum += around(i) * (r * r * r * 2.0f / 3.0f);
    area += r * r;
  }
  return area > 0.0f ? sum / area : vec3(0.0f);
}

// The middle of the room, as far as it can be reached from `place` without coming closer to walls than at the start.
vec3 middle_of(vec3 place, const Clearance& clearance) {
  float room = nearest_wall(place, clearance);
  for (int step = 0; step < 4; step++) {
    const vec3 way = to_middle(place, clearance);
    const float distance = length(way);
    if (!(distance > 1e-3f * room)) break;
    if (clearance(place, way / distance) <= distance) continue;
    const float there = nearest_wall(place + way, clearance);
    if (there < room) break;
    place += way;
    room = there;
  }
  return place;
}

float height_above_floor(vec3 place, const Clearance& clearance) {
  return clearance(place, -kUp);
}

}  // namespace

std::optional<CeilingLamp> place_lamp(vec3 eye, const Clearance& clearance) {
  const auto below_ceiling = [&](vec3 from) -> std::optional<vec3> {
    const float above = clearance(from, kUp), below = height_above_floor(from, clearance);
    if (!std::isfinite(above) || !std::isfinite(below)) return std::nullopt;
    return from + kUp * std::max(above - kDrop * (above + below), -0.5f * below);
  };
  const std::optional<vec3> start = below_ceiling(eye);
  if (!start) return std::nullopt;
  const std::optional<vec3> place = below_ceiling(middle_of(*start, clearance));  // the ceiling may be higher there
  return lamp_at(place.value_or(*start), clearance);
}

CeilingLamp lamp_at(vec3 position, const Clearance& clearance) {
  CeilingLamp lamp;
  lamp.position = position;
  const float height = height_above_floor(position, clearance);
  if (std::isfinite(height) && height > 0.0f) lamp.height = height;
  lamp.radius = std::min(kSize * lamp.height, 0.5f * nearest_wall(position, clearance));
  return lamp;
}

void add_lamp(Scene& scene, const CeilingLamp& lamp) {
  // A disc of radiance L gives pi L times the sine squared of the angle under which its radius is seen.
  const float reach = lamp.radius * lamp.radius + lamp.height * lamp.height;
  const vec3 color(1.0f, 0.96f, 0.9f);
  Material material = glow(color * (kFloor / luminance(color) * reach / (lamp.radius * lamp.radius)));
  material.double_sided = 0;
  add(scene, make_disc(lamp.radius, 48), add_material(scene, material),
      placed(lamp.position) * turned(vec3(1.0f, 0.0f, 0.0f), 180.0f));
  scene.instances.back().role = kDimmedLamp;
  if (!scene.hidden.empty()) scene.hidden.resize(scene.instances.size(), 0);
}

}  // namespace ods
