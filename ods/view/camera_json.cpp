// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/camera_json.h"

#include <nlohmann/json.hpp>
#include <span>

namespace ods {

static Json numbers(vec2 v) {
  return {v.x, v.y};
}

static Json numbers(vec3 v) {
  return {v.x, v.y, v.z};
}

static Json merge_json(const PoleMerge& merge) {
  return {{"mode", merge.mode}, {"start", merge.start}, {"end", merge.end}, {"exponent", merge.exponent}};
}

static Json map_json(const CameraMap& map, const float* values, bool wanted) {
  if (!wanted || map.width == 0) return {{"width", 0}, {"height", 0}};
  const std::span texels(values, static_cast<size_t>(map.width) * static_cast<size_t>(map.height));
  return {{"width", map.width}, {"height", map.height}, {"texels", texels}};
}

static Json projection_json(const Projection& projection) {
  return {{"kind", projection.kind},
          {"center", numbers(projection.center)},
          {"span", numbers(projection.span)},
          {"angle", projection.angle},
          {"circle", numbers(projection.circle)},
          {"sensor", numbers(projection.sensor)},
          {"k0", projection.k0},
          {"k1", projection.k1},
          {"k2", projection.k2},
          {"k3", projection.k3},
          {"k4", projection.k4},
          {"half_size", numbers(projection.half_size)},
          {"lens_right", numbers(projection.lens_right)},
          {"lens_up", numbers(projection.lens_up)},
          {"lens_back", numbers(projection.lens_back)}};
}

Json camera_json(const Camera& camera, bool has_points) {
  const bool has_maps = has_points || camera.convergence == kToeIn;
  return {{"axis", numbers(camera.axis)},
          {"ipd", camera.ipd},
          {"neck", camera.neck},
          {"convergence", camera.convergence},
          {"convergence_distance", camera.convergence_distance},
          {"top", merge_json(camera.top)},
          {"bottom", merge_json(camera.bottom)},
          {"projection", projection_json(camera.projection)},
          {"merge_map", map_json(camera.merge_map, camera.merge_texels, has_maps)},
          {"head_tilt_map", map_json(camera.head_tilt_map, camera.head_tilt_texels, has_maps)},
          {"texel_rays", map_json(camera.texel_rays, nullptr, false)}};  // none; three.js wants every member
}

}  // namespace ods
