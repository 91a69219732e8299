// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/mapping.h"

#include <algorithm>
#include <cmath>

namespace ods {

constexpr float kWidestSeam = 0.1f;  // radians: parallax doubles close objects in the seam

// The depth of the direction inside lens 1 minus its depth inside lens 0, radians. Sets `overlap` to the overlap of
// their circles.
static float balance_of_lenses(const StoredPicture& picture, vec3 direction, float& overlap) {
  const float first = picture.maps[0]->inside(direction), second = picture.maps[1]->inside(direction);
  overlap = first + second;  // axes are opposite
  return second - first;
}

static vec3 in_picture(const Source& source, vec3 direction) {
  const Camera& camera = source.camera;
  return {dot(direction, camera.right), dot(direction, camera.up), dot(direction, camera.back)};
}

WeightedPlace Mapping::other_lens(int index, vec2 home, vec2 uv) const {
  if (!source.picture->front_and_back) return {};
  const Ray ray = ray_of(index, home, uv);
  if (ray.direction == vec3(0.0f)) return {};
  float overlap = 0.0f;
  const float balance = balance_of_lenses(*source.picture, in_picture(source, ray.direction), overlap);
  const float seam = std::min(overlap, kWidestSeam);
  if (!(seam > 0.0f)) return {};
  const float share = 0.5f - std::abs(balance) / (2.0f * seam);  // balance changes twice as fast as the angle
  if (!(share > 0.0f)) return {};
  const Place place = place_of_line(source, balance > 0.0f ? 0 : 1, ray.direction);
  return {place, place.seen ? share : 0.0f};
}

Place Mapping::find(int index, vec2 home, vec2 uv) const {
  const size_t i = static_cast<size_t>(index);
  const Ray ray = ray_of(index, home, uv);
  if (ray.direction == vec3(0.0f)) return {};
  int source_eye = from[i];
  if (camera.projection.kind == kLatLong && eyes[i] != kMono) {
    const float phi = camera.projection.center.y + (0.5f - uv.y) * camera.projection.span.y;
    if (abs(phi) > 0.5f * kPi) source_eye = eye_over_pole(source, source_eye, phi > 0.0f);
  }
  if (!source.picture->front_and_back) return place_of_line(source, source_eye, ray.direction);
  float overlap = 0.0f;
  const bool is_behind = balance_of_lenses(*source.picture, in_picture(source, ray.direction), overlap) > 0.0f;
  return place_of_line(source, is_behind ? 1 : 0, ray.direction);
}

bool is_turned(const ConvertTarget& target) {
  return target.turned.yaw != 0.0f || target.turned.pitch != 0.0f || target.turned.roll != 0.0f;
}

static glm::mat3 turn_back(const Camera& camera, const ViewAngles& turned) {
  const auto radians = [](float degrees) { return glm::radians(static_cast<double>(degrees)); };
  const auto axes = orientation(radians(turned.yaw), radians(turned.pitch), radians(turned.roll));
  const glm::mat3 frame(camera.right, camera.up, camera.back), own(axes[0], axes[1], axes[2]);
  return frame * glm::transpose(own) * glm::transpose(frame);
}

Mapping make_mapping(const StoredPicture& picture, const ConvertTarget& target) {
  Mapping mapping{target.camera, make_source(picture), make_camera(target.camera), target.eye, target.eyes, {}, {}};
  mapping.camera.center = vec3(0.0f);
  mapping.camera.lens_radius = 0.0f;
  if (moves_pixels(target.right)) mapping.source.right = target.right;
  for (const int eye : target.eyes) mapping.from.push_back(eye_index(picture, eye == kMono ? target.mono_from : eye));
  if (is_turned(target)) mapping.turn = turn_back(mapping.source.camera, target.turned);
  return mapping;
}

}  // namespace ods
