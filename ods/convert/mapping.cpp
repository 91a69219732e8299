// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/mapping.h"

namespace ods {

Place Mapping::find(int index, vec2 home, vec2 uv) const {
  const size_t i = static_cast<size_t>(index);
  const Ray ray = ray_of(index, home, uv);
  if (ray.direction == vec3(0.0f)) return {};
  int source_eye = from[i];
  if (camera.projection.kind == kLatLong && eyes[i] != kMono) {
    const float phi = camera.projection.center.y + (0.5f - uv.y) * camera.projection.span.y;
    if (abs(phi) > 0.5f * kPi) source_eye = eye_over_pole(source, source_eye, phi > 0.0f);
  }
  return place_of_line(source, source_eye, turn ? *turn * ray.direction : ray.direction);
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
