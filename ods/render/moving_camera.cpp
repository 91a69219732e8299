// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/moving_camera.h"

#include <algorithm>
#include <cassert>

namespace ods {

Camera camera_at(std::span<const Camera> cameras, float time) {
  assert(cameras.size() >= 2);
  const auto last = static_cast<float>(cameras.size() - 1);
  const size_t before = std::min(static_cast<size_t>(time * last), cameras.size() - 2);
  const Camera &a = cameras[before], &b = cameras[before + 1];
  const float share = time * last - static_cast<float>(before);
  Camera camera = cameras[cameras.size() / 2];
  camera.center = mix(a.center, b.center, share);
  camera.back = normalize(mix(a.back, b.back, share));
  const vec3 up = mix(a.up, b.up, share);
  camera.up = normalize(up - camera.back * dot(up, camera.back));
  camera.right = cross(camera.up, camera.back) * (dot(cross(a.up, a.back), a.right) < 0.0f ? -1.0f : 1.0f);
  camera.axis = mix(a.axis, b.axis, share);
  if (a.axis != b.axis) camera.axis = normalize(camera.axis);
  return camera;
}

}  // namespace ods
