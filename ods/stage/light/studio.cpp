// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/light/studio.h"

#include <cassert>
#include <cmath>

#include "ods/kernel/camera/camera.h"
#include "ods/scene/builtin/builder.h"

namespace ods {
namespace {

// A rectangle of light with soft edges, in degrees.
struct SoftBox {
  float azimuth;  // clockwise from the viewer's line of sight
  float elevation;
  vec2 half_size;  // across and upwards, to the middle of the soft edge
  float soft;      // half the width of the soft edge
  vec3 radiance;
};

const SoftBox kBoxes[] = {
    {-135.0f, 48.0f, {19.0f, 14.0f}, 8.0f, vec3(15.0f, 14.6f, 14.0f)},  // key
    {118.0f, 22.0f, {34.0f, 26.0f}, 20.0f, vec3(0.95f, 0.98f, 1.04f)},  // fill
    {36.0f, 50.0f, {13.0f, 20.0f}, 9.0f, vec3(5.6f, 5.8f, 6.2f)},       // rim
    {-48.0f, 44.0f, {8.0f, 24.0f}, 7.0f, vec3(3.6f, 3.7f, 3.9f)},       // second rim
};

constexpr vec3 kStudioFloor(0.184f, 0.18f, 0.176f);
constexpr vec3 kHorizon(0.27f);  // approximately the floor's own radiance
constexpr float kWallToFloor = 1.9f;
constexpr int kStudioWidth = 512;

// The direction relative to the box's centre: degrees to the right of it and above it.
vec2 seen_from(const SoftBox& box, vec3 direction) {
  const float azimuth = glm::radians(box.azimuth);
  const vec3 forward = direction_of(azimuth, glm::radians(box.elevation));
  const vec3 right(cos(azimuth), 0.0f, sin(azimuth));
  const vec3 up = cross(right, forward);
  const float ahead = dot(direction, forward);
  return glm::degrees(vec2(std::atan2(dot(direction, right), ahead), std::atan2(dot(direction, up), ahead)));
}

// 1 inside a box with rounded soft edges, 0 outside.
float cover(const SoftBox& box, vec3 direction) {
  const vec2 past = abs(seen_from(box, direction)) - box.half_size + box.soft;
  const float distance = length(max(past, vec2(0.0f))) + min(max(past.x, past.y), 0.0f);
  return 1.0f - smoothstep(0.0f, 2.0f * box.soft, distance);
}

float elevation_of(vec3 direction) {
  return glm::degrees(std::asin(clamp(direction.y, -1.0f, 1.0f)));
}

// A gradient without a line at the horizon: from the floor's radiance there through a brighter band, against which
// glass and dark objects stand out, to a dark ceiling.
vec3 wall(vec3 horizon, vec3 direction) {
  const float elevation = elevation_of(direction);
  const vec3 lit = horizon * mix(1.0f, kWallToFloor, smoothstep(0.0f, 8.0f, elevation));
  return mix(lit, vec3(0.03f, 0.031f, 0.036f), smoothstep(10.0f, 50.0f, elevation));
}

vec3 with_lights(vec3 light, vec3 direction) {
  for (const SoftBox& box : kBoxes) light = mix(light, box.radiance, cover(box, direction));
  return light;
}

// The radiance of the floor under all these lights.
vec3 floor_radiance() {
  constexpr int kRows = 90, kColumns = 180;
  glm::dvec3 sum(0.0);
  for (int y = 0; y < kRows; y++) {
    const float elevation = 0.5f * kPi * (float(y) + 0.5f) / float(kRows);
    for (int x = 0; x < kColumns; x++) {
      const float azimuth = 2.0f * kPi * (float(x) + 0.5f) / float(kColumns);
      const vec3 direction = direction_of(azimuth, elevation);
      const vec3 light = with_lights(wall(kHorizon, direction), direction);
      sum += glm::dvec3(light * (sin(elevation) * cos(elevation)));
    }
  }
  return kStudioFloor * vec3(sum * (1.0 / (double{kRows} * kColumns)) * double{kPi});
}

}  // namespace

Environment make_studio(float yaw) {
  const vec3 floor = floor_radiance();
  const float turned = glm::radians(yaw);
  return make_environment(kStudioWidth, [&](vec3 direction) {
    const vec3 own(direction.x * cos(turned) + direction.z * sin(turned), direction.y,
                   direction.z * cos(turned) - direction.x * sin(turned));
    return own.y < 0.0f ? floor : with_lights(wall(floor, own), own);
  });
}

Environment make_studio_walls() {
  const vec3 floor = floor_radiance();
  return make_environment(kStudioWidth, [&](vec3 direction) { return wall(floor, direction); });
}

vec3 studio_floor() {
  return kStudioFloor;
}

void add_ground(Scene& scene, vec3 center, float radius, vec3 albedo) {
  assert(radius > 0.0f);
  Material material = matte(albedo);
  material.double_sided = 0;
  add(scene, make_disc(radius, 192), add_material(scene, material), placed(center));
  scene.instances.back().role = kFadingGround;
  if (!scene.hidden.empty()) scene.hidden.resize(scene.instances.size(), 0);
}

}  // namespace ods
