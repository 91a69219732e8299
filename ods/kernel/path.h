// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// One step of a path. The device owns the loop:
//
//   PathState state = start_path(...);
//   while (state.alive) {
//     state = shade(state, closest_hit(state.ray), settings);
//     if (state.shadow_pending && !occluded(state.shadow_ray, state.shadow_length)) state = add_shadow_light(state);
//   }
//
// shade() traces nothing: it consumes a hit, adds light, and leaves the next ray, and a shadow ray with the light that
// it would bring. A path gathers light in two ways, a ray towards a picked light and the scattered ray that happens to
// meet one, weighted by the power heuristic (Veach 1997).
#ifdef __cplusplus
#pragma once
#include "ods/kernel/medium.h"
#include "ods/kernel/random.h"
namespace ods {
#endif

const int kLightSamplingBoth = 0;
const int kLightSamplingLightsOnly = 1;
const int kLightSamplingBsdfOnly = 2;

struct PathSettings {
  int bounces;  // a path has at most bounces + 1 segments
  int light_sampling;
};

struct PathState {
  Ray ray;
  vec3 throughput;
  vec3 radiance;
  bool alive;
  int bounce;
  int passed;       // surfaces gone through without a bounce since the last one
  float density;    // with which the ray's direction was found; 0: camera or mirror, no other way would find it
  float travelled;  // from the last bounce to the ray's origin
  Media media;
  uint seed;   // of the pixel
  uint index;  // of the sample

  Ray shadow_ray;
  float shadow_length;
  vec3 shadow_light;
  bool shadow_pending;

  // First hit, for the layers beside the picture.
  float depth;  // along the camera's ray from its own origin; negative: nothing was met
  vec3 normal;
  vec3 albedo;
};

const int kMaxPassed = 64;

// Number pairs of a path: 0 places the sample in its pixel, then four for each bounce.
const uint kPixelPair = 0u;
const uint kScatterPair = 1u;  // lobe, roulette
const uint kDirectionPair = 2u;
const uint kLightPair = 3u;
const uint kLightPointPair = 4u;
const uint kPairsPerBounce = 4u;

#ifdef __cplusplus
struct PathTracer : MediumReader {
#endif

  inline PathState start_path(Ray ray, uint seed, uint index) {
    PathState state;
    state.ray = ray;
    state.throughput = vec3(1.0f);
    state.radiance = vec3(0.0f);
    state.alive = true;
    state.bounce = 0;
    state.passed = 0;
    state.density = 0.0f;
    state.travelled = 0.0f;
    state.media = no_media();
    state.seed = seed;
    state.index = index;
    state.shadow_ray = ray;
    state.shadow_length = 0.0f;
    state.shadow_light = vec3(0.0f);
    state.shadow_pending = false;
    state.depth = -1.0f;
    state.normal = vec3(0.0f);
    state.albedo = vec3(0.0f);
    return state;
  }

  inline PathState add_shadow_light(PathState state) {
    state.radiance += state.shadow_light;
    return state;
  }

  inline vec2 path_random(PathState state, uint pair) {
    return random_pair(state.seed, state.index, pair + uint(state.bounce) * kPairsPerBounce);
  }

  // Lottery number for surfaces with alpha: one for each ray and triangle, the same however often a device asks.
  inline float alpha_draw(uint ray_key, Hit hit) {
    return unit_float(hash_pair(ray_key, hash_pair(uint(hit.instance), uint(hit.triangle))));
  }

  inline uint ray_key(PathState state, uint kind) {
    return hash_pair(hash_pair(state.seed, state.index), uint(state.bounce) * 2u + kind);
  }

  // Weight of light that was found with density a and could have been found with density b too.
  inline float power_heuristic(float a, float b) {
    float ratio = b / a;
    return 1.0f / (1.0f + ratio * ratio);
  }

  // Weight of light that the path's own ray has met, which light sampling finds with light_density.
  inline float scattered_weight(PathState state, PathSettings settings, float light_density) {
    if (state.density <= 0.0f || light_density <= 0.0f) return 1.0f;
    if (settings.light_sampling == kLightSamplingBsdfOnly) return 1.0f;
    if (settings.light_sampling == kLightSamplingLightsOnly) return 0.0f;
    return power_heuristic(state.density, light_density);
  }

  inline PathState end_path(PathState state) {
    state.alive = false;
    return state;
  }

  inline PathState meet_environment(PathState state, PathSettings settings) {
    float weight = scattered_weight(state, settings, environment_density(state.ray.direction));
    state.radiance += state.throughput * environment_radiance(state.ray.direction) * weight;
    return end_path(state);
  }

  // Goes on straight through a surface that does not count.
  inline PathState pass_through(PathState state, Surface surface, float t) {
    state.ray.origin = offset_point(surface.position, -surface.geometric);
    state.travelled += t;
    state.passed += 1;
    if (state.passed > kMaxPassed) return end_path(state);
    return state;
  }

  // Leaves a shadow ray towards a picked light in the state.
  inline PathState aim_at_light(PathState state, PathSettings settings, Surface surface, Bsdf bsdf, int medium,
                                int beyond) {
    vec2 pick = path_random(state, kLightPair);
    LightSample light = sample_light(surface.position, pick, path_random(state, kLightPointPair));
    if (!light.valid) return state;
    BsdfValue scattered = bsdf_value(bsdf, light.direction);
    bool through = dot(light.direction, surface.geometric) < 0.0f;
    float weight = light.density > 0.0f ? 1.0f / light.density : 1.0f;
    if (light.density > 0.0f && settings.light_sampling == kLightSamplingBoth) {
      weight = weight * power_heuristic(light.density, scattered.density);
    }
    int crossed = through ? beyond : medium;
    vec3 arriving = light.radiance * medium_transmittance(crossed, light.distance) * weight;
    state.shadow_light = state.throughput * scattered.value * arriving;
    if (!(max(state.shadow_light.x, max(state.shadow_light.y, state.shadow_light.z)) > 0.0f)) return state;
    state.shadow_ray.origin = offset_point(surface.position, through ? -surface.geometric : surface.geometric);
    state.shadow_ray.direction = light.direction;
    state.shadow_length = light.distance * 0.9999f;
    state.shadow_pending = true;
    return state;
  }

  // Ends dim paths at random and makes the others brighter by as much: no bias. Source: Arvo and Kirk, 1990.
  inline PathState play_roulette(PathState state, float draw) {
    float chance = max(state.throughput.x, max(state.throughput.y, state.throughput.z));
    if (chance >= 1.0f) return state;
    if (!(draw < chance)) return end_path(state);
    state.throughput = state.throughput * (1.0f / chance);
    return state;
  }

  inline PathState scatter(PathState state, Surface surface, Bsdf bsdf, Media beyond) {
    vec2 pick = path_random(state, kScatterPair);
    BsdfSample found = sample_bsdf(bsdf, pick.x, path_random(state, kDirectionPair));
    state.throughput = state.throughput * found.weight;
    state.ray.origin = offset_point(surface.position, found.through ? -surface.geometric : surface.geometric);
    state.ray.direction = found.direction;
    state.density = found.density;
    state.travelled = 0.0f;
    state.passed = 0;
    if (found.through && surface.volume) state.media = beyond;
    state.bounce += 1;
    return play_roulette(state, pick.y);
  }

  inline PathState note_first_hit(PathState state, Surface surface, float t) {
    state.depth = state.travelled + t;
    state.normal = surface.normal;
    state.albedo = surface.base_color;
    return state;
  }

  inline PathState shade(PathState state, Hit hit, PathSettings settings) {
    state.shadow_pending = false;
    int medium = current_medium(state.media);
    if (hit.t < 0.0f) {
      state.throughput = state.throughput * medium_transmittance(medium, 1e30f);
      return meet_environment(state, settings);
    }
    int material_index = scene_mesh(scene_instance(hit.instance).mesh).material;
    Material material = scene_material(material_index);
    Surface surface = surface_at(hit, state.ray.direction);

    // glTF culls the backs of single-sided surfaces: the camera looks through them, light does not.
    bool volume = surface.volume;
    bool culled = state.bounce == 0 && !surface.front && material.double_sided == 0 && !volume;
    if (culled) return pass_through(state, surface, hit.t);

    Media beyond_media = state.media;
    if (volume) {
      // A ray that meets the inside of a volume it never entered started in there.
      if (!surface.front && !inside_medium(state.media, material_index)) {
        state.media = enter_medium(state.media, material_index);
        medium = current_medium(state.media);
      }
      beyond_media =
          surface.front ? enter_medium(state.media, material_index) : leave_medium(state.media, material_index);
    }
    int beyond = current_medium(beyond_media);
    state.throughput = state.throughput * medium_transmittance(medium, hit.t);
    if (volume && beyond == medium) {
      state.media = beyond_media;
      return pass_through(state, surface, hit.t);
    }

    if (state.bounce == 0) state = note_first_hit(state, surface, hit.t);
    if (material.unlit == 1) {
      state.radiance += state.throughput * surface.base_color;
      return end_path(state);
    }
    if (surface.emission.x + surface.emission.y + surface.emission.z > 0.0f) {
      float distance = state.travelled + hit.t;
      float weight = scattered_weight(state, settings, triangle_density(hit, state.ray.direction, distance));
      state.radiance += state.throughput * surface.emission * weight;
    }
    if (state.bounce == settings.bounces) return end_path(state);

    Bsdf bsdf = make_bsdf(surface, state.ray.direction, volume ? medium_ior(beyond) / medium_ior(medium) : surface.ior);
    if (settings.light_sampling != kLightSamplingBsdfOnly) {
      state = aim_at_light(state, settings, surface, bsdf, medium, beyond);
    }
    return scatter(state, surface, bsdf, beyond_media);
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif
