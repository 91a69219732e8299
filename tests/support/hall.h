// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The distance of the walls of World::kHall.
#pragma once
#include <algorithm>

#include "ods/kernel/camera/camera.h"
#include "tests/support/worlds.h"

namespace ods {

inline float hall_depth(vec3 origin, vec3 direction) {
  const vec3 low(-2.2f, -1.5f, -3.1f), high(2.9f, 1.4f, 3.6f);
  float t = 1e9f;
  for (int i = 0; i < 3; i++) {
    if (direction[i] != 0.0f) t = std::min(t, ((direction[i] > 0.0f ? high[i] : low[i]) - origin[i]) / direction[i]);
  }
  return t;
}

inline Image hall_depth(const StereoCamera& stereo, int eye, Extent size) {
  const Camera camera = make_camera(stereo);
  Image depth(size.width, size.height, 1);
  for (int y = 0; y < size.height; y++) {
    for (int x = 0; x < size.width; x++) {
      const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(size.width),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(size.height));
      const Ray ray = camera_ray(camera, eye, uv);
      *depth.at(x, y) = hall_depth(ray.origin, ray.direction);
    }
  }
  return depth;
}

inline Image grey_of(const Image& color) {
  Image grey(color.width, color.height, 1);
  for (size_t i = 0; i < grey.pixels.size(); i++) {
    grey.pixels[i] =
        0.2126f * color.pixels[3 * i] + 0.7152f * color.pixels[3 * i + 1] + 0.0722f * color.pixels[3 * i + 2];
  }
  return grey;
}

}  // namespace ods
