// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the volumes that the camera is in.
#pragma once
#include <algorithm>
#include <vector>

#include "ods/kernel/path.h"

namespace ods {

// The volumes that contain a point: those that a ray from there leaves more often than it enters. `closest_hit` is the
// device's function that returns the first hit along a ray, with a negative t if there is none.
template <typename ClosestHit>
Media media_at(PathTracer& tracer, vec3 point, const ClosestHit& closest_hit) {
  Media inside = no_media();
  std::vector<int> entered;
  Ray ray{point, normalize(vec3(0.31f, 0.83f, 0.47f))};  // an arbitrary direction; an axis would be parallel to walls
  for (int i = 0; i < kMaxPassed; i++) {
    const Hit hit = closest_hit(ray);
    if (hit.t < 0.0f) break;
    const auto surface = tracer.surface_at(hit, ray.direction, false);
    const int material = tracer.scene_mesh(tracer.scene_instance(hit.instance).mesh).material;
    if (surface.volume && surface.front) entered.push_back(material);
    if (surface.volume && !surface.front) {
      const auto entry = std::find(entered.begin(), entered.end(), material);
      if (entry != entered.end())
        entered.erase(entry);
      else
        inside = enter_medium(inside, material);
    }
    ray.origin = offset_point(surface.position, -surface.geometric);
  }
  return inside;
}

}  // namespace ods
