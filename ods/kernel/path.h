// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// One step of a path. The device owns the loop:
//
//   start_path(...);
//   while (path.alive) {
//     shade(closest_hit(path.ray), settings);
//     if (!path.shadow_pending || is_occluded_by_other_than_clear_glass(path.shadow_ray, path.shadow_length)) continue;
//     for (each surface of clear glass that the shadow ray meets) pass_shadow(closest_hit(path.shadow_ray));
//     add_shadow_light();
//   }
//
// shade() traces nothing. It consumes a hit, adds light, and leaves the next ray and a shadow ray with the light that
// the shadow ray would bring. The state is `path`, and what lives within one step is `this_step`: members of PathTracer
// in C++, globals of the invocation in a shader. (A first version passed and returned the state by value; the copies
// cost a third of the time on the CPU.)
//
// A catcher (an Instance of the role kCatcher) is invisible except for the shadows cast on it. If the first surface of
// a path is a catcher, the path carries no radiance: it continues straight towards a light, whose direction is sampled
// as for a white Lambert surface. It records how much of that light arrives with the whole scene present (light_with),
// and how much would arrive if only catchers and emitters were present (light_without). Of all else in between, only
// clear glass lets light through. The sums over a pixel's paths give
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
#include "ods/kernel/light_cache.h"
namespace ods {
#endif

// A surface that the path has reached.
struct PathVertex {
  Surface surface;
  Hit hit;
  Media beyond_media;  // the volumes behind the surface
  int medium;          // the volume before the surface
  int beyond;          // the volume behind it
  bool unlit;
};

#ifdef __cplusplus
struct PathTracer : LightCacheReader {
#endif

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
    path.receiver.position = ray.origin;
    path.receiver.normal = vec3(0.0f);
    path.media = media;
    path.shadow_media = media;
    path.wave = -1;
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
    path.mirrored = false;
    path.depth = -1.0f;
    path.normal = vec3(0.0f);
    path.albedo = vec3(0.0f);
  }

  // Shares the path with the other eye, which sees the point that the path's first ray hits along this direction (unit
  // length). density: Counterpart::density, times the other pixel's number of samples over this pixel's. Call it before
  // the first shade().
  inline void share_path(vec3 direction, float density) {
    path.both_see = true;
    path.other_direction = direction;
    path.other_density = density;
  }

  // Continues the path straight through a surface.
  inline void go_on(Surface surface, float t) {
    path.ray.origin = offset_point(surface.position, -surface.geometric);
    if (path.bounce == 0) path.both_see = false;
    path.travelled += t;
    path.passed += 1;
    if (path.passed > kMaxPassed) path.alive = false;
  }

  // Continues straight through a surface that stops shadow rays: only this ray passes it.
  inline void pass_through(Surface surface, float t) {
    path.pdf = 0.0f;
    path.other_pdf = 0.0f;
    go_on(surface, t);
  }

  // Restricts the path to one colour, weighted for all three.
  inline void take_wave(int wave) {
    path.wave = wave;
    this_step.chosen_wave = -1;
    path.throughput = path.throughput * vec3(wave == kRedWave ? 3.0f : 0.0f, wave == kGreenWave ? 3.0f : 0.0f,
                                             wave == kBlueWave ? 3.0f : 0.0f);
  }

  // The ratio of indices at the surface of a volume. If they depend on the colour of light, the path chooses one
  // colour. Smooth surfaces reflect all colours in the same direction, so there it keeps the colour only if it is
  // refracted.
  inline float volume_eta(Surface surface, int medium, int beyond) {
    if (path.wave < 0 && max(medium_dispersion(medium), medium_dispersion(beyond)) > 0.0f) {
      int wave = min(int(path_random(kCandidatePair).y * 3.0f), 2);
      bool keeps_all =
          surface.layered && surface.roughness * surface.roughness < kSmoothAlpha && surface_layers.anisotropy <= 0.0f;
      if (!keeps_all) {
        take_wave(wave);
      } else {
        this_step.chosen_wave = wave;
        surface_layers.wave_eta = vec3(medium_ior(beyond, kRedWave) / medium_ior(medium, kRedWave),
                                       medium_ior(beyond, kGreenWave) / medium_ior(medium, kGreenWave),
                                       medium_ior(beyond, kBlueWave) / medium_ior(medium, kBlueWave));
      }
    }
    int wave = this_step.chosen_wave >= 0 ? this_step.chosen_wave : path.wave;
    return medium_ior(beyond, wave) / medium_ior(medium, wave);
  }

  // Evaluates the first surface for the other eye. Not shared are surfaces that only one eye sees, surfaces almost in
  // line with an eye's ray, and shading normals that were bent towards a viewer.
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
    this_step.other = make_view_bsdf(kOtherView, surface, path.other_direction, eta);
  }

  // Divides the light that a scattered ray will find between the eyes.
  inline void share_scattered(BsdfSample found) {
    if (!(found.pdf > 0.0f)) return;
    BsdfValue value = bsdf_value(this_step.other, found.direction);
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

  // Scatters the path. clear: whether the surface is clear glass; the path then passes it at the distance t.
  inline void scatter(Surface surface, Bsdf bsdf, Media beyond, bool clear, float t) {
    vec2 pick = path_random(kScatterPair);
    BsdfSample found = sample_bsdf(bsdf, pick.x, path_random(kDirectionPair));
    path.throughput = path.throughput * found.weight;
    if (clear && found.through && found.pdf <= 0.0f) {
      if (surface.volume) path.media = beyond;
      go_on(surface, t);
      return;
    }
    path.ray.origin = offset_point(surface.position, found.through ? -surface.geometric : surface.geometric);
    path.ray.direction = found.direction;
    path.pdf = found.pdf;
    path.other_pdf = found.pdf;
    if (path.both_see && path.bounce == 0) share_scattered(found);
    path.travelled = 0.0f;
    path.receiver = receiver_of(surface);
    path.passed = 0;
    if (found.through && surface.volume) {
      path.media = beyond;
      if (this_step.chosen_wave >= 0) take_wave(this_step.chosen_wave);
    }
    path.bounce += 1;
    play_roulette(pick.y);
  }

  // Stores normal and albedo for the denoiser, and the depth.
  // A ground that fades into the background gets a tiny normal and no albedo, so that the denoiser does not separate
  // the two. The normal is not zero: zero means sky.
  // Clear glass is skipped: the surface behind it is stored.
  // A mirror has its own depth, but the normal and the albedo of the surface that it reflects.
  inline void note_hit(Surface surface, float t, bool fades) {
    if (path.bounce == 0) path.depth = path.travelled + t;
    path.normal = fades ? 0.01f * surface.normal : surface.normal;
    path.albedo = vec3(0.0f);
    path.mirrored =
        !fades && !surface.layered && surface.metallic > 0.9f && surface.roughness * surface.roughness < kSmoothAlpha;
    if (fades) return;
    path.albedo = surface.layered ? albedo_of_layers(surface, path.ray.direction) : surface.base_color;
    if (path.bounce + path.passed > 0) path.albedo = path.albedo * min(path.throughput, vec3(1.0f));
  }

  // Handles a catcher as the path's first surface: the path continues to a light, or to a sky that is not in the light
  // table.
  inline void catch_shadows(Surface surface, PathSettings settings) {
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
      shadow_towards(surface, found.direction, kFarAway, vec3(0.0f), path.media);
    } else {
      settings.light_sampling = kLightSamplingLightsOnly;
      aim_at_light(settings, surface, white, path.media);
    }
    path.caught = true;
    path.both_see = false;
    path.unblocked = 1.0f;
    path.light_without = 0.0f;
    path.light_with = 0.0f;
    path.alive = path.shadow_pending;
    path.shadow_pending = false;
    path.ray = path.shadow_ray;
    path.passed = 0;
    path.bounce = 1;
    if (sky && lamps) path.shadow_light = path.shadow_light * 2.0f;
    path.shadow_alone = path.shadow_light;
  }

  // One step of a path from a catcher to a light: it ends at the light, at a catcher or at an emitter, and passes
  // through everything else. Only clear glass lets light through.
  inline void go_to_light(Hit hit) {
    bool arrived = hit.t < 0.0f || hit.t >= path.shadow_length;
    if (arrived) {
      path.light_without = luminance(path.shadow_alone);
      path.light_with = luminance(path.shadow_light) * path.unblocked;
    }
    path.alive =
        !arrived && scene_instance(hit.instance).role != kCatcher && scene_instance(hit.instance).first_light < 0;
    if (!path.alive) return;
    if (is_clear(hit, true)) {
      vec3 without = path.shadow_alone;
      pass_shadow(hit);
      path.shadow_alone = without;
    } else {
      path.unblocked = 0.0f;
      shorten_shadow(surface_at(hit, path.ray.direction, true));
    }
    path.ray = path.shadow_ray;
    path.passed += 1;
    if (path.passed > kMaxPassed) path.alive = false;
  }

  // Ends the path with the light from the cache instead of tracing further, if the cache has it.
  inline bool end_in_cache(PathSettings settings, Surface surface, float distance) {
    vec3 light = cached_light(surface, distance);
    if (light.x < 0.0f) return false;
    light = light * path.throughput;
    light = light * clamped(settings, light * path.alone_ratio, path.bounce + 1);
    add_light(light, light);
    path.alive = false;
    return true;
  }

  inline void keep_vertex(Surface surface) {
    this_step.vertex = cache_place(surface);
    this_step.vertex_bounce = path.bounce;
    this_step.vertex_throughput = path.throughput;
    this_step.vertex_radiance = path.radiance;
  }

  // The light that a surface emits back along the path's ray, less the part that its coat absorbs.
  inline vec3 emission_seen(Surface surface, Hit hit) {
    if (!surface.layered) return surface.emission;
    Material material = scene_material(scene_mesh(scene_instance(hit.instance).mesh).material);
    float cosine = abs(dot(surface.geometric, path.ray.direction));
    return surface.emission * emission_below_coat(material, corners_of(hit), cosine);
  }

  // Continues the path straight behind a lamp of the role kPureLight. A shadow ray could have found the surfaces behind
  // it.
  inline void pass_pure_light(Surface surface, Hit hit, PathSettings settings) {
    path.throughput = path.throughput * medium_transmittance(current_medium(path.media), hit.t);
    if (surface.emission.x + surface.emission.y + surface.emission.z > 0.0f) {
      if (path.mirrored) note_hit(surface, hit.t, false);
      path.mirrored = false;
      float light_pdf = 0.0f;
      if (path.pdf > 0.0f) light_pdf = hit_light_pdf(hit, path.receiver, path.ray.direction, path.travelled + hit.t);
      meet_light(settings, emission_seen(surface, hit), light_pdf);
    }
    go_on(surface, hit.t);
  }

  inline void leave_scene(PathSettings settings) {
    path.throughput = path.throughput * medium_transmittance(current_medium(path.media), kFarAway);
    meet_environment(settings);
  }

  // glTF culls the backs of single-sided surfaces: the camera sees through them, light does not.
  inline bool is_culled(Surface surface, Hit hit) {
    int material = scene_mesh(scene_instance(hit.instance).mesh).material;
    return path.bounce == 0 && !surface.front && scene_material(material).double_sided == 0 && !surface.volume;
  }

  // Takes the path to a surface: through the volume before it, whose light it weakens.
  inline PathVertex arrive(Surface surface, Hit hit) {
    PathVertex vertex;
    vertex.surface = surface;
    vertex.hit = hit;
    vertex.beyond_media = path.media;
    vertex.medium = current_medium(path.media);
    int material = scene_mesh(scene_instance(hit.instance).mesh).material;
    vertex.unlit = scene_material(material).unlit == 1;
    if (surface.volume) {
      path.media = media_before(path.media, surface.front, material);
      vertex.medium = current_medium(path.media);
      vertex.beyond_media = media_behind(path.media, surface.front, material);
    }
    vertex.beyond = current_medium(vertex.beyond_media);
    path.throughput = path.throughput * medium_transmittance(vertex.medium, hit.t);
    return vertex;
  }

  // Adds the light that the surface emits.
  inline void emit(PathVertex vertex, PathSettings settings) {
    Surface surface = vertex.surface;
    Hit hit = vertex.hit;
    bool glows = surface.emission.x + surface.emission.y + surface.emission.z > 0.0f;
    if (vertex.unlit || !glows) return;
    float distance = path.travelled + hit.t;
    vec3 emission = emission_seen(surface, hit);
    if (path.bounce == 0 && scene_instance(hit.instance).role == kDimmedLamp) emission = dimmed(emission);
    float light_pdf = 0.0f;
    if (path.pdf > 0.0f) light_pdf = hit_light_pdf(hit, path.receiver, path.ray.direction, distance);
    meet_light(settings, emission, light_pdf);
  }

  // Returns whether the path ends here: on an unlit surface, at its last bounce, or in the light cache. clear: whether
  // the surface is clear glass, which is not a bounce.
  inline bool ends(PathVertex vertex, bool clear, PathSettings settings) {
    if (vertex.unlit) {
      vec3 light = path.throughput * vertex.surface.base_color;
      add_light(light, light);
      path.alive = false;
      return true;
    }
    if (path.bounce == settings.bounces && !clear) {
      path.alive = false;
      return true;
    }
    if (settings.keep_vertices) keep_vertex(vertex.surface);
    return path.bounce > 0 && !clear && end_in_cache(settings, vertex.surface, path.travelled + vertex.hit.t);
  }

  // Samples a light and scatters the path; at the last bounce it only passes clear glass.
  inline void scatter_at(PathVertex vertex, bool clear, PathSettings settings) {
    Surface surface = vertex.surface;
    float eta = surface.ior;
    if (surface.volume) {
      eta =
          clear ? clear_eta(surface, vertex.medium, vertex.beyond) : volume_eta(surface, vertex.medium, vertex.beyond);
    }
    Bsdf bsdf = make_bsdf(surface, path.ray.direction, eta);
    if (path.bounce == settings.bounces) {
      path.throughput = path.throughput * straight_transmittance(bsdf);
      path.media = vertex.beyond_media;
      go_on(surface, vertex.hit.t);
      return;
    }
    if (path.both_see && path.bounce == 0) share_surface(surface, path.ray.direction, eta);
    if (settings.light_sampling != kLightSamplingBsdfOnly) aim_at_light(settings, surface, bsdf, vertex.beyond_media);
    scatter(surface, bsdf, vertex.beyond_media, clear, vertex.hit.t);
  }

  inline void shade(Hit hit, PathSettings settings) {
    path.shadow_pending = false;
    this_step.chosen_wave = -1;
    this_step.vertex_bounce = -1;
    if (kHasCatchers && path.caught) {
      go_to_light(hit);
      return;
    }
    if (hit.t < 0.0f) {
      leave_scene(settings);
      return;
    }
    bool reduced = path.pdf > 0.0f && path.pdf < kBroadPdf;
    Surface surface = surface_at(hit, path.ray.direction, reduced);
    if (surface.layered) read_layers(hit, surface, path.ray.direction, reduced);
    int role = scene_instance(hit.instance).role;
    if (role == kPureLight) {
      pass_pure_light(surface, hit, settings);
      return;
    }
    if (is_culled(surface, hit)) {
      pass_through(surface, hit.t);
      return;
    }
    if (kHasCatchers && path.bounce == 0 && role == kCatcher) {
      path.depth = path.travelled + hit.t;
      catch_shadows(surface, settings);
      return;
    }
    PathVertex vertex = arrive(surface, hit);
    emit(vertex, settings);
    if (surface.volume && vertex.beyond == vertex.medium) {  // the wall of a volume inside a denser volume
      path.media = vertex.beyond_media;
      pass_through(surface, hit.t);
      return;
    }
    if (path.bounce == 0 || path.mirrored) note_hit(surface, hit.t, role == kFadingGround);
    bool clear = surface.transmission > 0.0f && is_clear(hit, path.pdf > 0.0f);
    if (!ends(vertex, clear, settings)) scatter_at(vertex, clear, settings);
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif
