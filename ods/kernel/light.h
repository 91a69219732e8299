// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Picking a light and a point on it, and the density with which that would have found a given ray's light.
// Lights are picked by power from Walker's alias table, which the host makes (ods/scene/lights.h).
#ifdef __cplusplus
#pragma once
#include "ods/kernel/bsdf.h"
namespace ods {
#endif

struct LightSample {
  vec3 direction;  // towards the light, unit length
  float distance;
  vec3 radiance;  // arriving, over density where that is 0 (points and directions have no size)
  float density;  // per solid angle, the chance of picking the light included
  bool valid;
};

// Index of an entry of an alias table of n entries, picked by u in [0, 1), before asking the threshold.
inline int alias_slot(float u, int n) {
  return min(int(u * float(n)), n - 1);
}

// KHR_lights_punctual's fall-off: inverse square, faded out to zero at the range.
inline float punctual_falloff(float distance, float range) {
  float inverse_square = 1.0f / max(distance * distance, 1e-12f);
  if (range <= 0.0f) return inverse_square;
  float share = distance / range;
  float share2 = share * share;
  return inverse_square * clamp(1.0f - share2 * share2, 0.0f, 1.0f);
}

// Position of a direction in a lat-long picture, both coordinates 0..1.
inline vec2 direction_to_lat_long(vec3 d) {
  return vec2(0.5f + atan(d.x, -d.z) * (0.5f / kPi), 0.5f - asin(clamp(d.y, -1.0f, 1.0f)) * (1.0f / kPi));
}

#ifdef __cplusplus
struct LightSampler : BsdfEvaluator {
#endif

  inline vec3 environment_texel(EnvironmentInfo info, int x, int y) {
    int column = wrap_texel(x, info.width, kWrapRepeat);
    int row = clamp(y, 0, info.height - 1);
    return scene_environment_texel(row * info.width + column).radiance;
  }

  inline vec3 environment_radiance(vec3 direction) {
    EnvironmentInfo info = scene_environment();
    if (info.width == 0) return info.uniform_radiance;
    vec2 uv = direction_to_lat_long(direction);
    float x = uv.x * float(info.width) - 0.5f;
    float y = uv.y * float(info.height) - 0.5f;
    int x0 = int(floor(x));
    int y0 = int(floor(y));
    vec3 top = mix(environment_texel(info, x0, y0), environment_texel(info, x0 + 1, y0), x - floor(x));
    vec3 bottom = mix(environment_texel(info, x0, y0 + 1), environment_texel(info, x0 + 1, y0 + 1), x - floor(x));
    return mix(top, bottom, y - floor(y));
  }

  // Solid angle of a texel of row y: all texels of a row share it.
  inline float environment_texel_angle(EnvironmentInfo info, int y) {
    float top = cos(kPi * float(y) / float(info.height));
    float bottom = cos(kPi * float(y + 1) / float(info.height));
    return 2.0f * kPi / float(info.width) * (top - bottom);
  }

  // Density per solid angle with which sample_light finds the environment in a direction.
  inline float environment_density(vec3 direction) {
    EnvironmentInfo info = scene_environment();
    if (info.light < 0) return 0.0f;
    vec2 uv = direction_to_lat_long(direction);
    int x = clamp(int(uv.x * float(info.width)), 0, info.width - 1);
    int y = clamp(int(uv.y * float(info.height)), 0, info.height - 1);
    float pick = scene_light(info.light).probability * scene_environment_texel(y * info.width + x).probability;
    return pick / environment_texel_angle(info, y);
  }

  // The same for the triangle of a hit, seen from a point at distance along direction.
  inline float triangle_density(Hit hit, vec3 direction, float distance) {
    Instance instance = scene_instance(hit.instance);
    if (instance.first_light < 0) return 0.0f;
    Corners k = corners_of(hit);
    vec3 a = to_world(instance, k.a.position);
    vec3 area = cross(to_world(instance, k.b.position) - a, to_world(instance, k.c.position) - a) * 0.5f;
    float projected = abs(dot(area, direction));
    float pick = scene_light(instance.first_light + hit.triangle).probability;
    return projected > 0.0f ? pick * distance * distance / projected : 0.0f;
  }

  inline LightSample sample_triangle(Light light, vec3 from, vec2 uv) {
    Hit hit;
    hit.t = 0.0f;
    float root = sqrt(uv.x);
    hit.u = root * (1.0f - uv.y);
    hit.v = root * uv.y;
    hit.instance = light.instance;
    hit.triangle = light.triangle;
    Instance instance = scene_instance(hit.instance);
    Corners k = corners_of(hit);
    vec3 a = to_world(instance, k.a.position);
    vec3 ab = to_world(instance, k.b.position) - a;
    vec3 ac = to_world(instance, k.c.position) - a;
    vec3 to_light = a + ab * hit.u + ac * hit.v - from;
    LightSample result;
    result.distance = length(to_light);
    result.direction = to_light * (1.0f / max(result.distance, 1e-20f));
    result.density = triangle_density(hit, result.direction, result.distance);
    result.valid = result.density > 0.0f && result.distance > 0.0f;
    result.radiance = vec3(0.0f);
    if (result.valid) {
      int material = scene_mesh(instance.mesh).material;
      result.radiance = surface_at(hit, result.direction).emission;
      // A ray would pass through the rest.
      if (scene_material(material).alpha_mode != kAlphaOpaque) {
        result.radiance = result.radiance * alpha_of(scene_material(material), k);
      }
    }
    return result;
  }

  inline LightSample sample_punctual(Light light, vec3 from) {
    LightSample result;
    result.density = 0.0f;
    result.valid = true;
    result.distance = 1e30f;
    result.direction = -light.direction;
    result.radiance = light.intensity;
    if (light.kind != kLightDirectional) {
      vec3 to_light = light.position - from;
      result.distance = length(to_light);
      result.direction = to_light * (1.0f / max(result.distance, 1e-20f));
      result.radiance = light.intensity * punctual_falloff(result.distance, light.range);
      if (light.kind == kLightSpot) {
        float cone = clamp(-dot(result.direction, light.direction) * light.cone_scale + light.cone_offset, 0.0f, 1.0f);
        result.radiance = result.radiance * (cone * cone);
      }
    }
    result.radiance = result.radiance * (1.0f / light.probability);
    return result;
  }

  inline LightSample sample_environment(vec2 pick, vec2 uv) {
    EnvironmentInfo info = scene_environment();
    int count = info.width * info.height;
    int index = alias_slot(pick.x, count);
    EnvironmentTexel texel = scene_environment_texel(index);
    if (pick.y >= texel.alias_threshold) index = texel.alias;
    int row = index / info.width;
    int column = index - row * info.width;
    float theta = ((float(column) + uv.x) / float(info.width) - 0.5f) * (2.0f * kPi);
    float top = cos(kPi * float(row) / float(info.height));
    float bottom = cos(kPi * float(row + 1) / float(info.height));
    float height = mix(top, bottom, uv.y);
    float r = sqrt(max(1.0f - height * height, 0.0f));
    LightSample result;
    result.direction = vec3(r * sin(theta), height, -r * cos(theta));
    result.distance = 1e30f;
    result.radiance = environment_radiance(result.direction);
    result.density = environment_density(result.direction);
    result.valid = result.density > 0.0f;
    return result;
  }

  // pick chooses the light (and the texel of an environment), uv the point on it; all uniform in [0, 1).
  inline LightSample sample_light(vec3 from, vec2 pick, vec2 uv) {
    LightSample nothing;
    nothing.valid = false;
    nothing.direction = vec3(0.0f);
    nothing.radiance = vec3(0.0f);
    nothing.distance = 0.0f;
    nothing.density = 0.0f;
    int count = scene_light_count();
    if (count == 0) return nothing;
    int index = alias_slot(pick.x, count);
    float left_over = clamp(pick.x * float(count) - float(index), 0.0f, 0.9999999f);
    float threshold = scene_light(index).alias_threshold;
    bool keep = left_over < threshold;
    left_over = keep ? left_over / threshold : (left_over - threshold) / (1.0f - threshold);
    if (!keep) index = scene_light(index).alias;
    Light light = scene_light(index);
    if (light.kind == kLightTriangle) return sample_triangle(light, from, uv);
    if (light.kind == kLightEnvironment) return sample_environment(vec2(pick.y, left_over), uv);
    return sample_punctual(light, from);
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif
