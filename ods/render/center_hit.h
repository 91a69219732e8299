// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The hit of the ray through a pixel's centre: depth and objects are not averaged.
#pragma once
#include "ods/kernel/camera/texel_ray.h"
#include "ods/kernel/path.h"
#include "ods/render/render_options.h"
#include "ods/render/render_passes.h"

namespace ods {

inline PathSettings path_settings(const RenderOptions& options) {
  return {options.bounces, static_cast<int>(options.light_sampling), false, options.clamp};
}

// The depth as t; negative if there is no hit. The path's state in the tracer is that of the hit. closest_hit: the
// device's first hit along the tracer's own path.ray, of the kind kHalfAlphaRay.
template <typename Tracer, typename ClosestHit>
Hit center_hit(Tracer& tracer, const Camera& camera, const Media& media, const RenderOptions& options, int eye, int x,
               int y, const ClosestHit& closest_hit) {
  Hit hit{-1.0f, 0.0f, 0.0f, -1, -1};
  const vec2 center = pixel_center(options, x, y);
  const Ray ray = sample_ray(camera, eye, center, center, vec2(0.0f));
  if (ray.direction == vec3(0.0f)) return hit;
  PathSettings first_hit_only = path_settings(options);
  first_hit_only.bounces = 0;
  tracer.ray_time = 0.5f;
  tracer.start_path(ray, media, pixel_seed(options, eye, x, y), 0u);
  while (tracer.path.alive && !tracer.path.caught) {
    hit = closest_hit(tracer);
    tracer.shade(hit, first_hit_only);
  }
  hit.t = tracer.path.depth;
  return hit;
}

}  // namespace ods
