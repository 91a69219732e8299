// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// One step of a path. The device owns the loop:
//
//   start_path(...);
//   while (path.alive) {
//     shade(closest_hit(path.ray), settings);
//     if (path.shadow_pending && !occluded(path.shadow_ray, path.shadow_length)) add_shadow_light();
//   }
//
// shade() traces nothing. It consumes a hit, adds light, and leaves the next ray and a shadow ray with the light that
// the shadow ray would bring. The state is `path`: a member of PathTracer in C++, a global of the invocation in a
// shader. (A first version passed and returned it by value; the copies cost a third of the time on the CPU.) A path
// gathers light in two ways, by a ray towards a sampled light and by a scattered ray that happens to hit one, weighted
// by the power heuristic (Veach 1997).
//
// A catcher (an Instance of the role kCatcher) is invisible except for the shadows cast on it. If the first surface of
// a path is a catcher, the path carries no radiance: it continues straight towards a light, whose direction is sampled
// as for a white Lambert surface. It records how much of that light arrives with the whole scene present (light_with),
// and how much would arrive if only catchers and emitters were present (light_without). Anything else in between blocks
// the light completely, even glass. The sums over a pixel's paths give
//
//   alpha = 1 - light_with / light_without
//
// For all other paths (reflected, refracted or scattered) a catcher is an ordinary surface.
//
// Both eyes from one path: if the other eye sees the path's first surface, too, the light that the path finds from
// there on goes to both (share_path()). Each way in which a pixel's light is found, by its own paths and by those of
// the other eye, is weighted by how likely it finds that light (Veach's balance heuristic), so neither adds noise where
// it fits badly: a mirror has no light to share, a glossy surface little. What the surface emits belongs to its own
// path alone.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/path_state.h"
#include "ods/kernel/random.h"
namespace ods {
#endif

#ifdef __cplusplus
struct PathTracer : MediumReader {
#endif

  PathState path;

  // media: the volumes that the camera is in, no_media() in air. The whole path is at ray_time (ods/kernel/surface.h).
  inline void start_path(Ray ray, Media media, uint seed, uint index) {
    path.ray = ray;
    path.throughput = vec3(1.0f);
    path.radiance = vec3(0.0f);
    path.alive = true;
    path.bounce = 0;
    path.passed = 0;
    path.pdf = 0.0f;
    path.travelled = 0.0f;
    path.media = media;
    path.wave = -1;
    path.chosen_wave = -1;
    path.seed = seed;
    path.index = index;
    path.shadow_pending = false;
    path.both_see = false;
    path.own_share = 1.0f;
    path.other_ratio = vec3(0.0f);
    path.alone_ratio = 1.0f;
    path.other_pdf = 0.0f;
    path.other_radiance = vec3(0.0f);
    path.alone_radiance = vec3(0.0f);
    path.caught = false;
    path.depth = -1.0f;
    path.normal = vec3(0.0f);
    path.albedo = vec3(0.0f);
  }

  // The other eye sees the point that the path's first ray hits, along this direction (unit length). density: of
  // Counterpart, times the other pixel's number of samples over this pixel's. Before the first shade().
  inline void share_path(vec3 direction, float density) {
    path.both_see = true;
    path.other_direction = direction;
    path.other_density = density;
  }

  // What PathSettings::clamp leaves of light that comes by way of so many surfaces.
  inline float clamped(PathSettings settings, vec3 light, int surfaces) {
    float mean = (light.x + light.y + light.z) * (1.0f / 3.0f);
    if (settings.clamp <= 0.0f || surfaces < 2 || mean <= settings.clamp) return 1.0f;
    return settings.clamp / mean;
  }

  inline void add_light(vec3 light, vec3 light_for_other) {
    path.radiance += light;
    path.alone_radiance += light * path.alone_ratio;
    path.other_radiance += light_for_other * path.other_ratio;
  }

  inline void add_shadow_light() {
    path.radiance += path.shadow_light;
    path.alone_radiance += path.shadow_alone;
    path.other_radiance += path.shadow_other;
  }

  inline vec2 path_random(uint pair) {
    return random_pair(path.seed, path.index, pair + uint(path.bounce) * kPairsPerBounce);
  }

  // The random number for surfaces with alpha: one for each ray and triangle, the same however often a device asks.
  inline float alpha_draw(int ray, Hit hit) {
    if (ray == kHalfAlphaRay) return 0.5f;
    uint key = hash_pair(hash_pair(path.seed, path.index), uint(path.bounce) * 2u + uint(ray));
    return unit_float(hash_pair(key, hash_pair(uint(hit.instance), uint(hit.triangle))));
  }

  // Weight of light that was found with pdf a and could also have been found with pdf b.
  inline float power_heuristic(float a, float b) {
    float ratio = b / a;
    return 1.0f / (1.0f + ratio * ratio);
  }

  // Weight of light that the path's own ray hit, which light sampling finds with light_pdf.
  inline float scattered_weight(PathSettings settings, float pdf, float light_pdf) {
    if (pdf <= 0.0f || light_pdf <= 0.0f) return 1.0f;
    if (settings.light_sampling == kLightSamplingBsdfOnly) return 1.0f;
    if (settings.light_sampling == kLightSamplingLightsOnly) return 0.0f;
    return power_heuristic(pdf, light_pdf);
  }

  inline void meet_light(PathSettings settings, vec3 light, float light_pdf) {
    vec3 arriving = path.throughput * light;
    arriving = arriving * clamped(settings, arriving * path.alone_ratio, path.bounce);
    float weight = scattered_weight(settings, path.pdf, light_pdf);
    float other_weight = weight;
    if (path.other_pdf != path.pdf) other_weight = scattered_weight(settings, path.other_pdf, light_pdf);
    add_light(arriving * weight, arriving * other_weight);
  }

  // A lamp as the camera sees it: beyond display white, its rim would be ragged.
  inline vec3 dimmed(vec3 emission) {
    return emission * min(1.0f, kSeenLamp / luminance(emission));
  }

  inline void meet_environment(PathSettings settings) {
    if (path.bounce == 0) {
      meet_light(settings, background_radiance(path.ray.direction), 0.0f);
    } else {
      meet_light(settings, environment_radiance(path.ray.direction), environment_pdf(path.ray.direction));
    }
    path.alive = false;
  }

  // Continues straight through a surface that does not interact. Shadow rays stop there: only this ray goes beyond it.
  inline void pass_through(Surface surface, float t) {
    path.ray.origin = offset_point(surface.position, -surface.geometric);
    path.pdf = 0.0f;
    path.other_pdf = 0.0f;
    if (path.bounce == 0) path.both_see = false;
    path.travelled += t;
    path.passed += 1;
    if (path.passed > kMaxPassed) path.alive = false;
  }

  // The unoccluded light that a light source would bring along the path, over its pdf.
  inline vec3 unshadowed_light(PathSettings settings, Bsdf bsdf, LightSample light, int medium) {
    BsdfValue scattered = bsdf_value(bsdf, light.direction);
    float weight = 1.0f;
    if (light.pdf > 0.0f) weight = 1.0f / light.pdf;
    if (light.pdf > 0.0f && settings.light_sampling == kLightSamplingBoth) {
      weight = weight * power_heuristic(light.pdf, scattered.pdf);
    }
    return light.radiance * scattered.value * medium_transmittance(medium, light.distance) * weight;
  }

  // Both ends of the ray are offset from their surfaces: it misses nothing between them, and neither surface stops it.
  inline void shadow_towards(Surface surface, vec3 direction, float distance, vec3 end) {
    bool through = dot(direction, surface.geometric) < 0.0f;
    path.shadow_ray.origin = offset_point(surface.position, through ? -surface.geometric : surface.geometric);
    path.shadow_ray.direction = direction;
    path.shadow_length = distance;
    if (distance < kFarAway) {
      vec3 to_light = end - path.shadow_ray.origin;
      path.shadow_length = length(to_light);
      path.shadow_ray.direction = to_light * (1.0f / max(path.shadow_length, 1e-20f));
    }
    path.shadow_pending = path.shadow_length > 0.0f;
  }

  // Leaves a shadow ray towards a light: of several picked by power, it chooses one by the light that it would bring
  // here.
  // Source: Talbot, Cline and Egbert, "Importance Resampling for Global Illumination", 2005.
  inline void aim_at_light(PathSettings settings, Surface surface, Bsdf bsdf, int medium, int beyond) {
    int candidates = min(scene_light_pick_count(), path.bounce == 0 ? kLightCandidates : 1);
    if (candidates == 0) return;
    float draw = path_random(kCandidatePair).x;
    float total = 0.0f;
    LightSample chosen = no_light();
    vec3 chosen_light = vec3(0.0f);
    float chosen_brightness = 0.0f;
    for (int i = 0; i < candidates; i++) {
      uint pair = kLightPair + 3u * uint(i);
      LightSample light =
          sample_light(surface.position, path_random(pair), path_random(pair + 1u), path_random(pair + 2u));
      if (!light.valid) continue;
      bool through = dot(light.direction, surface.geometric) < 0.0f;
      vec3 arriving = unshadowed_light(settings, bsdf, light, through ? beyond : medium);
      float brightness = luminance(arriving);
      if (!(brightness > 0.0f && brightness < kFarAway)) continue;
      total += brightness;
      float share = brightness / total;
      if (draw < share) {
        chosen = light;
        chosen_light = arriving;
        chosen_brightness = brightness;
        draw = draw / share;
      } else {
        draw = (draw - share) / (1.0f - share);
      }
    }
    if (!(total > 0.0f)) return;
    vec3 scale = path.throughput * (total / (float(candidates) * chosen_brightness));
    scale = scale * clamped(settings, chosen_light * scale * path.alone_ratio, path.bounce + 1);
    path.shadow_light = chosen_light * scale;
    path.shadow_alone = path.shadow_light * path.alone_ratio;
    path.shadow_other = path.shadow_light * path.other_ratio;
    if (path.both_see && path.bounce == 0) {
      bool through = dot(chosen.direction, surface.geometric) < 0.0f;
      vec3 for_other = unshadowed_light(settings, path.other, chosen, through ? beyond : medium);
      float own_share = chosen_brightness / (chosen_brightness + path.other_density * luminance(for_other));
      path.shadow_other = for_other * scale * (path.other_density * own_share);
      path.shadow_light = path.shadow_light * own_share;
    }
    shadow_towards(surface, chosen.direction, chosen.distance, chosen.end);
  }

  // From here on the path has one colour, for all three.
  inline void take_wave(int wave) {
    path.wave = wave;
    path.chosen_wave = -1;
    path.throughput = path.throughput * vec3(wave == kRedWave ? 3.0f : 0.0f, wave == kGreenWave ? 3.0f : 0.0f,
                                             wave == kBlueWave ? 3.0f : 0.0f);
  }

  // The ratio of indices at the surface of a volume. If they depend on the colour of light, the path chooses one.
  // Smooth surfaces reflect all colours alike, so there it takes the colour only if it is refracted.
  inline float volume_eta(Surface surface, int medium, int beyond) {
    path.chosen_wave = -1;
    if (path.wave < 0 && max(medium_dispersion(medium), medium_dispersion(beyond)) > 0.0f) {
      int wave = min(int(path_random(kCandidatePair).y * 3.0f), 2);
      bool keeps_all =
          surface.layered && surface.roughness * surface.roughness < kSmoothAlpha && surface_layers.anisotropy <= 0.0f;
      if (!keeps_all) take_wave(wave);
      if (keeps_all) {
        path.chosen_wave = wave;
        surface_layers.wave_eta = vec3(medium_ior(beyond, kRedWave) / medium_ior(medium, kRedWave),
                                       medium_ior(beyond, kGreenWave) / medium_ior(medium, kGreenWave),
                                       medium_ior(beyond, kBlueWave) / medium_ior(medium, kBlueWave));
      }
    }
    int wave = path.chosen_wave >= 0 ? path.chosen_wave : path.wave;
    return medium_ior(beyond, wave) / medium_ior(medium, wave);
  }

  // The first surface as the other eye sees it. Not shared: what only one eye sees, what lies almost in line with an
  // eye's ray, and shading normals that were bent towards a viewer.
  inline void share_surface(Surface surface, vec3 direction, float eta) {
    float here = -dot(direction, surface.geometric);
    float there = -dot(path.other_direction, surface.geometric);
    float facing = min(-dot(direction, surface.normal), -dot(path.other_direction, surface.normal));
    if (surface.layered) {
      vec3 coat = surface_layers.clearcoat_normal;
      facing = min(facing, min(-dot(direction, coat), -dot(path.other_direction, coat)));
    }
    path.both_see = min(here, there) > 0.02f && facing > 4e-3f && !surface.volume;
    if (!path.both_see) return;
    path.other_density = path.other_density * there / here;
    path.other = make_view_bsdf(kOtherView, surface, path.other_direction, eta);
  }

  // Divides the light that a scattered ray will find between the eyes.
  inline void share_scattered(BsdfSample found) {
    if (!(found.pdf > 0.0f)) return;
    BsdfValue value = bsdf_value(path.other, found.direction);
    float other_part = path.other_density * value.pdf;
    path.own_share = found.pdf / (found.pdf + other_part);
    path.alone_ratio = 1.0f / path.own_share;
    path.other_pdf = value.pdf;
    vec3 for_other = value.value * (path.other_density / found.pdf);
    if (found.weight.x > 0.0f) path.other_ratio.x = for_other.x / found.weight.x;
    if (found.weight.y > 0.0f) path.other_ratio.y = for_other.y / found.weight.y;
    if (found.weight.z > 0.0f) path.other_ratio.z = for_other.z / found.weight.z;
    path.throughput = path.throughput * path.own_share;
  }

  // Ends dim paths at random and makes the others brighter to match, which adds no bias. Source: Arvo and Kirk, 1990.
  inline void play_roulette(float draw) {
    vec3 both = path.throughput * (vec3(1.0f) + path.other_ratio);
    float chance = max(both.x, max(both.y, both.z)) / kRouletteThreshold;
    if (chance >= 1.0f) return;
    path.alive = draw < chance;
    if (path.alive) path.throughput = path.throughput * (1.0f / chance);
  }

  inline void scatter(Surface surface, Bsdf bsdf, Media beyond) {
    vec2 pick = path_random(kScatterPair);
    BsdfSample found = sample_bsdf(bsdf, pick.x, path_random(kDirectionPair));
    path.throughput = path.throughput * found.weight;
    path.ray.origin = offset_point(surface.position, found.through ? -surface.geometric : surface.geometric);
    path.ray.direction = found.direction;
    path.pdf = found.pdf;
    path.other_pdf = found.pdf;
    if (path.both_see && path.bounce == 0) share_scattered(found);
    path.travelled = 0.0f;
    path.passed = 0;
    if (found.through && surface.volume) {
      path.media = beyond;
      if (path.chosen_wave >= 0) take_wave(path.chosen_wave);
    }
    path.bounce += 1;
    play_roulette(pick.y);
  }

  // A ground that goes over into the background has next to no normal and no albedo, as that, or a denoiser would keep
  // them apart. But some normal, as bare sky is what has none.
  inline void note_first_hit(Surface surface, float t, bool fades) {
    path.depth = path.travelled + t;
    path.normal = fades ? 0.01f * surface.normal : surface.normal;
    if (fades) return;
    path.albedo = surface.layered ? albedo_of_layers(surface, path.ray.direction) : surface.base_color;
  }

  // The path's first surface is a catcher: from here on it goes to a light, or to a sky that is not in the light table.
  inline void catch_shadows(Surface surface, PathSettings settings, int medium) {
    surface.base_color = vec3(1.0f);
    surface.metallic = 0.0f;
    surface.roughness = 1.0f;
    surface.transmission = 0.0f;
    surface.ior = 1.0f;
    surface.volume = false;
    surface.layered = false;
    Bsdf white = make_bsdf(surface, path.ray.direction, 1.0f);
    bool lamps = scene_light_pick_count() > 0;
    bool sky = scene_environment().light < 0 && luminance(scene_environment().uniform_radiance) > 0.0f;
    bool to_sky = sky && (!lamps || path_random(kScatterPair).x < 0.5f);
    if (to_sky) {
      BsdfSample found = sample_bsdf(white, 0.0f, path_random(kDirectionPair));
      path.shadow_light = path.throughput * found.weight * scene_environment().uniform_radiance;
      shadow_towards(surface, found.direction, kFarAway, vec3(0.0f));
    } else {
      settings.light_sampling = kLightSamplingLightsOnly;
      aim_at_light(settings, surface, white, medium, medium);
    }
    path.caught = true;
    path.both_see = false;
    path.blocked = false;
    path.light_without = 0.0f;
    path.light_with = 0.0f;
    path.alive = path.shadow_pending;
    path.shadow_pending = false;
    path.ray = path.shadow_ray;
    path.passed = 0;
    path.bounce = 1;
    if (sky && lamps) path.shadow_light = path.shadow_light * 2.0f;
  }

  // One step of such a path: it ends at the light, at a catcher or at an emitter, and passes through all else.
  inline void go_to_light(Hit hit) {
    bool arrived = hit.t < 0.0f || hit.t >= path.shadow_length;
    if (arrived) {
      path.light_without = luminance(path.shadow_light);
      path.light_with = path.blocked ? 0.0f : path.light_without;
    }
    path.alive =
        !arrived && scene_instance(hit.instance).role != kCatcher && scene_instance(hit.instance).first_light < 0;
    if (!path.alive) return;
    path.blocked = true;
    vec3 end = path.shadow_ray.origin + path.shadow_ray.direction * path.shadow_length;
    pass_through(surface_at(hit, path.ray.direction, true), hit.t);
    path.shadow_ray.origin = path.ray.origin;
    if (path.shadow_length < kFarAway) {
      vec3 to_light = end - path.ray.origin;
      path.shadow_length = length(to_light);
      path.shadow_ray.direction = to_light * (1.0f / max(path.shadow_length, 1e-20f));
    }
    path.ray = path.shadow_ray;
  }

  inline void shade(Hit hit, PathSettings settings) {
    path.shadow_pending = false;
    if (path.caught) {
      go_to_light(hit);
      return;
    }
    int medium = current_medium(path.media);
    if (hit.t < 0.0f) {
      path.throughput = path.throughput * medium_transmittance(medium, kFarAway);
      meet_environment(settings);
      return;
    }
    int material_index = scene_mesh(scene_instance(hit.instance).mesh).material;
    bool reduced = path.pdf > 0.0f && path.pdf < kBroadPdf;
    Surface surface = surface_at(hit, path.ray.direction, reduced);
    if (surface.layered) read_layers(hit, surface, path.ray.direction, reduced);

    // glTF culls the backs of single-sided surfaces: the camera sees through them, light does not.
    bool volume = surface.volume;
    if (path.bounce == 0 && !surface.front && scene_material(material_index).double_sided == 0 && !volume) {
      pass_through(surface, hit.t);
      return;
    }
    if (path.bounce == 0 && scene_instance(hit.instance).role == kCatcher) {
      path.depth = path.travelled + hit.t;
      catch_shadows(surface, settings, medium);
      return;
    }

    Media beyond_media = path.media;
    if (volume) {
      // A ray that hits the inside of a volume it never entered started inside.
      if (!surface.front && !inside_medium(path.media, material_index)) {
        path.media = enter_medium(path.media, material_index);
        medium = current_medium(path.media);
      }
      if (surface.front) beyond_media = enter_medium(path.media, material_index);
      if (!surface.front) beyond_media = leave_medium(path.media, material_index);
    }
    int beyond = current_medium(beyond_media);
    path.throughput = path.throughput * medium_transmittance(medium, hit.t);
    bool unlit = scene_material(material_index).unlit == 1;
    if (!unlit && surface.emission.x + surface.emission.y + surface.emission.z > 0.0f) {
      float distance = path.travelled + hit.t;
      if (surface.layered) {
        float cosine = abs(dot(surface.geometric, path.ray.direction));
        surface.emission =
            surface.emission * emission_below_coat(scene_material(material_index), corners_of(hit), cosine);
      }
      if (path.bounce == 0 && scene_instance(hit.instance).role == kDimmedLamp)
        surface.emission = dimmed(surface.emission);
      meet_light(settings, surface.emission, hit_light_pdf(hit, path.ray.direction, distance));
    }
    // The wall of a volume inside a denser volume.
    if (volume && beyond == medium) {
      path.media = beyond_media;
      pass_through(surface, hit.t);
      return;
    }

    if (path.bounce == 0) note_first_hit(surface, hit.t, scene_instance(hit.instance).role == kFadingGround);
    if (unlit) {
      add_light(path.throughput * surface.base_color, path.throughput * surface.base_color);
      path.alive = false;
      return;
    }
    if (path.bounce == settings.bounces) {
      path.alive = false;
      return;
    }
    float eta = volume ? volume_eta(surface, medium, beyond) : surface.ior;
    Bsdf bsdf = make_bsdf(surface, path.ray.direction, eta);
    if (path.both_see && path.bounce == 0) share_surface(surface, path.ray.direction, eta);
    if (settings.light_sampling != kLightSamplingBsdfOnly) aim_at_light(settings, surface, bsdf, medium, beyond);
    scatter(surface, bsdf, beyond_media);
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif
