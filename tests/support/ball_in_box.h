// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A world in closed form, and pictures of it with depth: a ball in a box.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "ods/kernel/camera/camera.h"
#include "tests/support/stored_pictures.h"

namespace ods {

inline const vec3 kBox(3.0f, 2.0f, 3.0f);  // half sizes
inline const vec3 kBall(0.4f, -0.1f, -1.2f);
inline const float kRadius = 0.35f;

struct Seen {
  float depth;
  bool ball;
  vec3 color;
};

inline Seen look_at_world(const Ray& ray) {
  float box = 1e9f;
  for (int i = 0; i < 3; i++) {
    const float d = ray.direction[i];
    if (d != 0.0f) box = std::min(box, (std::copysign(kBox[i], d) - ray.origin[i]) / d);
  }
  const vec3 away = ray.origin - kBall;
  const float b = dot(away, ray.direction), square = b * b - dot(away, away) + kRadius * kRadius;
  const bool ball = square > 0.0f && -b - std::sqrt(square) > 0.0f;
  const float depth = ball ? -b - std::sqrt(square) : box;
  const vec3 p = ray.origin + ray.direction * depth;
  const vec3 color =
      ball ? vec3(0.9f, 0.2f + 0.1f * std::sin(9.0f * p.x), 0.1f)
           : vec3(0.1f, 0.5f + 0.3f * std::sin(4.0f * p.x + 3.0f * p.z), 0.5f + 0.3f * std::sin(4.0f * p.y));
  return {depth, ball, color};
}

inline MadePicture picture_of_world(const StereoCamera& stereo, Extent size, const std::vector<int>& eyes) {
  MadePicture made = make_picture(stereo, size, eyes);
  const Camera camera = make_camera(stereo);
  add_colour(made, [&](int eye, vec2 uv, float* out) {
    const vec3 color = look_at_world(camera_ray(camera, eye, uv)).color;
    std::copy(&color[0], &color[0] + 3, out);
  });
  add_layer<float>(made, {"Z"}, LayerRule::kNearest, SampleType::kFloat,
                   [&](int eye, vec2 uv, float* out) { *out = look_at_world(camera_ray(camera, eye, uv)).depth; });
  return made;
}

}  // namespace ods
