// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Rays from a table instead of a projection: those of a texture whose texels lie on surfaces.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/camera/camera.h"
namespace ods {
#endif

// The rays of a texel: from origin + x * across + y * down, with x and y from -1/2 to 1/2 within the texel.
struct TexelRay {
  vec3 origin;
  vec3 direction;  // unit length; 0 if the texel is empty
  vec3 across;
  vec3 down;
};

#ifdef __cplusplus
inline const TexelRay& camera_texel_ray(const Camera& camera, int i) {
  return camera.texel_table[i];
}
#else
TexelRay camera_texel_ray(Camera camera, int i);
#endif

// The ray of a sample: that of the camera's table, for the texel that contains `home`, or camera_ray() if it has none.
// A table has no eyes and no lens.
inline Ray sample_ray(Camera camera, int eye, vec2 home, vec2 uv, vec2 lens) {
  int width = camera.texel_rays.width;
  int height = camera.texel_rays.height;
  if (width == 0) return camera_ray(camera, eye, home, uv, lens);
  vec2 size = vec2(float(width), float(height));
  int x = clamp(int(home.x * size.x), 0, width - 1);
  int y = clamp(int(home.y * size.y), 0, height - 1);
  TexelRay texel = camera_texel_ray(camera, y * width + x);
  vec2 within = uv * size - vec2(float(x) + 0.5f, float(y) + 0.5f);
  Ray ray;
  ray.origin = texel.origin + within.x * texel.across + within.y * texel.down;
  ray.direction = texel.direction;
  return ray;
}

#ifdef __cplusplus
}  // namespace ods
#endif
