// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/light/sky.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "ods/kernel/light.h"
#include "ods/render/lights.h"

namespace ods {
namespace {

// The number of points along one side of a texel, so that they are not farther apart than the background's own texels.
int points_along(vec3 side, const EnvironmentInfo& background) {
  if (background.width == 0) return 1;
  const float texel = kPi / static_cast<float>(background.height);
  return std::max(static_cast<int>(std::ceil(length(side) / texel)), 1);
}

vec3 mean_background(LightSampler& sky, const TexelRay& texel) {
  const int columns = points_along(texel.across, sky.background), rows = points_along(texel.down, sky.background);
  vec3 sum(0.0f);
  for (int y = 0; y < rows; y++) {
    vec3 of_row(0.0f);
    for (int x = 0; x < columns; x++) {
      const float right = (static_cast<float>(x) + 0.5f) / static_cast<float>(columns) - 0.5f;
      const float down = (static_cast<float>(y) + 0.5f) / static_cast<float>(rows) - 0.5f;
      of_row += sky.background_radiance(normalize(texel.direction + right * texel.across + down * texel.down));
    }
    sum += of_row;
  }
  return sum / static_cast<float>(columns * rows);
}

}  // namespace

Image sky_of(const Scene& scene, const TexelRays& rays) {
  const size_t width = static_cast<size_t>(rays.width);
  assert(rays.rays.size() == width * static_cast<size_t>(rays.height));
  const LightTable lights = make_lights(scene);
  LightSampler sky;
  set_scene(sky, scene, lights);
  Image image(rays.width, rays.height, 3);
  tbb::parallel_for(0, rays.height, [&](int y) {
    LightSampler own = sky;
    for (int x = 0; x < rays.width; x++) {
      const TexelRay& texel = rays.rays[static_cast<size_t>(y) * width + static_cast<size_t>(x)];
      if (texel.direction == vec3(0.0f)) continue;
      const vec3 light = mean_background(own, texel);
      for (int c = 0; c < 3; c++) image.at(x, y)[c] = light[c];
    }
  });
  return image;
}

}  // namespace ods
