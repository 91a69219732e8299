// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>

#include "ods/camera/stereo_camera.h"
#include "tests/support/scenes.h"

namespace ods {

// A table without rays: every texel is empty.
inline TexelRays empty_texels(int width, int height) {
  const size_t texels = static_cast<size_t>(width) * static_cast<size_t>(height);
  return {width, height, std::vector<TexelRay>(texels), std::vector<int>(texels, -1)};
}

// The rays through the centres of a mono camera's pixels, of one owner.
inline TexelRays texels_of(const StereoCamera& stereo, int width, int height) {
  TexelRays texels = empty_texels(width, height);
  const Camera camera = make_camera(stereo);
  for (size_t i = 0; i < texels.rays.size(); i++) {
    const vec2 pixel(static_cast<float>(i % static_cast<size_t>(width)),
                     static_cast<float>(i / static_cast<size_t>(width)));
    const Ray ray =
        camera_ray(camera, kMono, (pixel + 0.5f) / vec2(static_cast<float>(width), static_cast<float>(height)));
    texels.rays[i].origin = ray.origin;
    texels.rays[i].direction = ray.direction;
    texels.owners[i] = 0;
  }
  return texels;
}

// Texels that lie on the square from `corner`, `across` to its right and `down`, and look at it along its back.
inline TexelRays texels_on(vec3 corner, vec3 across, vec3 down, int width, int height) {
  TexelRays texels = empty_texels(width, height);
  const vec3 right = across / static_cast<float>(width), below = down / static_cast<float>(height);
  const vec3 towards = normalize(cross(across, down));
  for (int y = 0; y < height; y++) {
    for (int x = 0; x < width; x++) {
      const size_t i = static_cast<size_t>(y * width + x);
      const vec3 at = corner + right * (static_cast<float>(x) + 0.5f) + below * (static_cast<float>(y) + 0.5f);
      texels.rays[i] = {at - 0.01f * towards, towards, right, below};
      texels.owners[i] = 0;
    }
  }
  return texels;
}

inline StereoCamera camera_of(TexelRays texels, vec3 viewer = vec3(0.0f)) {
  return texel_camera(std::make_shared<const TexelRays>(std::move(texels)), viewer);
}

}  // namespace ods
