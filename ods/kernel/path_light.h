// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The state of a path between its steps (ods/kernel/path.h), and the light that it finds in two ways: its own ray hits
// an emitter, or it aims a shadow ray at a light. The power heuristic weights the two (Veach 1997).
//
// Clear glass stops neither: light continues behind it in the same direction, less the light that the glass reflects
// and absorbs. A path that passes clear glass keeps the pdf of its direction, since a shadow ray could have found the
// light behind it. A smooth thin sheet is clear. A smooth solid is clear if `straight_solids` is set, for light
// scattered by surfaces; the camera, mirrors and glass see it refract. Rough glass is never clear: light through it is
// found only by the path's own rays.
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
  bool keep_vertices;  // for filling a light cache
  float clamp;  // maximum of the light that has met two surfaces or more, as the mean of R, G and B; 0 for no limit
};

// A point whose light can be stored in the light cache, and the albedo there.
struct CachePlace {
  vec3 position;
  vec3 normal;  // normal of the triangle, on the side that the light leaves
  vec3 albedo;
  float cell;  // size of the larger cell, metres; 0 if nothing is stored here
};

// The state of a path that survives between its steps: devices that trace many paths at once keep one for each.
struct PathState {
  Ray ray;
  vec3 throughput;
  vec3 radiance;
  bool alive;
  int bounce;
  int passed;  // surfaces passed through since the last bounce
  float pdf;   // pdf of the ray's direction; 0 if the camera or a mirror chose it, and light sampling could not have
               // found it
  float travelled;    // distance from the last bounce to the ray's origin
  Receiver receiver;  // the surface of the last bounce
  Media media;
  int wave;    // the one colour of a path that dispersion has split; -1 for all
  uint seed;   // the pixel's
  uint index;  // the sample's

  Ray shadow_ray;
  float shadow_length;
  Media shadow_media;  // the media that the shadow ray is in
  vec3 shadow_light;
  bool shadow_pending;

  // Both eyes from one path. Light for the other eye's pixel is in units of this eye's samples and needs no further
  // weight.
  bool both_see;         // the other eye sees the first surface, too
  vec3 other_direction;  // from the other eye to the first surface
  float other_density;   // density of the other eye's samples there, over this eye's
  float own_share;       // fraction of the light after the first surface that goes to this eye
  vec3 other_ratio;      // light for the other eye over light for this one; 0 if not shared
  float alone_ratio;     // light without sharing over light for this eye
  float other_pdf;       // like pdf, as if the other eye had chosen the ray's direction
  vec3 other_radiance;   // for the other eye's pixel
  vec3 alone_radiance;   // for this eye's pixel without sharing: shows the variance of a single path
  vec3 shadow_other;     // like shadow_light
  vec3 shadow_alone;

  bool caught;      // the first surface is a catcher; the next three fields are for such paths
  float unblocked;  // 0 if an object other than a catcher, an emitter or clear glass is in front of the light; else 1
  float light_without;  // luminance that arrives if only catchers and emitters are present
  float light_with;     // luminance that arrives with the whole scene present

  // The first hit, for the layers of the picture.
  bool mirrored;  // the path has met mirrors only
  float depth;    // along the camera ray from its own origin; negative if the ray hit nothing
  vec3 normal;
  vec3 albedo;
};

// The results of one shade(), which the device reads before the next.
struct PathStep {
  int chosen_wave;  // at a surface that splits colours, the colour that the path keeps if it is refracted; else -1
  Bsdf other;       // the first surface's, for the other eye, if both see it

  // For PathSettings::keep_vertices: the surface, before it scatters the path.
  CachePlace vertex;
  int vertex_bounce;  // -1 if shade() met no surface
  vec3 vertex_throughput;
  vec3 vertex_radiance;  // light found by the path before this surface
};

const int kMaxPassed = 1024;
const uint kPassedStride = 256u;  // bounces with separate random numbers after each surface passed through

// A ray scattered with a smaller pdf than this may have gone almost anywhere: the reduced copies of textures are sharp
// enough for its hit, and they fit the processor's cache. The full ones cost a fifth of the time on the atrium.
const float kBroadPdf = 2.0f;

// The camera sees a kDimmedLamp no brighter than this luminance: near display white at the
// exposure of a room that it lights.
const float kSeenLamp = 0.6f;

// Paths with a throughput below this may end at random. Lower values cost time, higher ones noise: of 1, 1/2, 1/4 and
// 0, 1/4 reaches a given noise soonest on interiors (./run bench, equal noise).
const float kRouletteThreshold = 0.25f;

// Maximum number of lights that the first surface considers for its shadow ray, one for each sun, the environment and
// the tree of all others; it chooses one in proportion to its contribution. Considering more from the tree, or more
// than one at deeper surfaces, does not pay off.
const int kLightCandidates = 3;

// The pairs of random numbers of a path: pair 0 places the sample in its pixel, one places it on the lens, one in the
// time that the shutter is open, then the pairs below follow for each bounce.
const uint kPixelPair = 0u;
const uint kLensPair = 0xffffffffu;
const uint kTimePair = 0xfffffffeu;
const uint kScatterPair = 1u;  // lobe, roulette
const uint kDirectionPair = 2u;
const uint kCandidatePair = 3u;  // selects the candidate; the colour that remains after dispersion
const uint kLightPair = 4u;      // from here on three pairs per candidate: light, cell of an environment, point
const uint kPairsPerBounce = 3u + 3u * uint(kLightCandidates);

// The ray that calls alpha_draw(): the path's next ray, its shadow ray, or a ray that hits exactly the surfaces with an
// alpha of at least one half.
const int kPathRay = 0;
const int kShadowRay = 1;
const int kHalfAlphaRay = 2;

#ifdef __cplusplus
struct PathLight : MediumReader {
#endif

  PathState path;
  PathStep this_step;

  // Light passes smooth solids unbent. The device sets it before a path starts.
  bool straight_solids = false;

  // The factor by which PathSettings::clamp scales light that has met this number of surfaces.
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

  // The random numbers of a bounce, and of a surface that the path meets after it has passed others since.
  inline uint path_place() {
    return uint(path.bounce) + kPassedStride * uint(path.passed);
  }

  inline vec2 path_random(uint pair) {
    return random_pair(path.seed, path.index, pair + path_place() * kPairsPerBounce);
  }

  // The random number for surfaces with alpha: one for each ray and triangle, the same for every call of a device.
  inline float alpha_draw(int ray, Hit hit) {
    if (ray == kHalfAlphaRay) return 0.5f;
    uint key = hash_pair(hash_pair(path.seed, path.index), path_place() * 2u + uint(ray));
    return unit_float(hash_pair(key, hash_pair(uint(hit.instance), uint(hit.triangle))));
  }

  // Returns whether an instance is invisible to a ray of the path. Every device calls this at each candidate hit of an
  // instance of these three roles.
  inline bool is_absent(int ray, int instance) {
    int role = scene_instance(instance).role;
    bool of_camera = ray != kShadowRay && path.bounce == 0;
    if (role == kPureLight) return ray != kPathRay || of_camera || path.caught;
    if (role == kOutline) return !of_camera;
    return role == kUnseen && of_camera;
  }

  // Weight of light that was found with pdf a and could also have been found with pdf b.
  inline float power_heuristic(float a, float b) {
    float ratio = b / a;
    return 1.0f / (1.0f + ratio * ratio);
  }

  // Weight of light that the path's own ray hit, and that light sampling finds with light_pdf.
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

  // A lamp's emission as the camera sees it. Beyond display white its rim would be ragged.
  inline vec3 dimmed(vec3 emission) {
    return emission * min(1.0f, kSeenLamp / luminance(emission));
  }

  inline void meet_environment(PathSettings settings) {
    if (path.bounce == 0) {
      path.depth = -1.0f;
      meet_light(settings, background_radiance(path.ray.direction), 0.0f);
    } else {
      if (path.mirrored) path.normal = path.albedo = vec3(0.0f);
      meet_light(settings, environment_radiance(path.ray.direction),
                 environment_pdf(path.receiver.position, path.ray.direction));
    }
    path.alive = false;
  }

  // --- clear glass

  // Returns whether light passes straight through a hit. Never in a solid for the camera and mirrors (scattered:
  // false).
  inline bool is_clear(Hit hit, bool scattered) {
    Material material = scene_material(scene_mesh(scene_instance(hit.instance).mesh).material);
    if (!(material.transmission > 0.0f) || material.unlit == 1) return false;
    if (material.thickness > 0.0f && !(straight_solids && scattered)) return false;
    if (material.layers >= 0 && scene_material_layers(material.layers).anisotropy > 0.0f) return false;
    Corners k = corners_of(hit);
    float roughness = material.roughness * slot_at(material.metallic_roughness_slot, uv0_of(k), uv1_of(k), false).y;
    return roughness * roughness < kSmoothAlpha;
  }

  // The ratio of indices by which clear glass reflects. A ray that leaves a solid without bending meets its wall at the
  // angle that the refracted ray would have outside, so it is never totally reflected.
  inline float clear_eta(Surface surface, int medium, int beyond) {
    if (!surface.volume) return surface.ior;
    float eta = medium_ior(beyond, -1) / medium_ior(medium, -1);
    return max(eta, 1.0f / eta);
  }

  // Turns the shadow ray so that it ends at a point.
  inline void end_shadow_at(vec3 end) {
    vec3 to_light = end - path.shadow_ray.origin;
    path.shadow_length = length(to_light);
    path.shadow_ray.direction = to_light * (1.0f / max(path.shadow_length, 1e-20f));
  }

  // Restarts the shadow ray behind a surface that it met.
  inline void shorten_shadow(Surface surface) {
    vec3 end = path.shadow_ray.origin + path.shadow_ray.direction * min(path.shadow_length, 1e10f);
    path.shadow_ray.origin = offset_point(surface.position, -surface.geometric);
    if (path.shadow_length < kFarAway) end_shadow_at(end);
  }

  // Continues the shadow ray behind clear glass with the transmitted light.
#ifdef __cplusplus
  [[gnu::noinline, gnu::flatten]]
#endif
  inline void
  pass_shadow(Hit hit) {
    vec3 direction = path.shadow_ray.direction;
    int material = scene_mesh(scene_instance(hit.instance).mesh).material;
    Surface surface = surface_at(hit, direction, false);
    if (surface.layered) read_layers(hit, surface, direction, false);
    if (surface.volume) path.shadow_media = media_before(path.shadow_media, surface.front, material);
    int medium = current_medium(path.shadow_media);
    if (surface.volume) path.shadow_media = media_behind(path.shadow_media, surface.front, material);
    int beyond = current_medium(path.shadow_media);
    vec3 passing = medium_transmittance(medium, hit.t);
    if (!surface.volume || medium != beyond) {
      passing = passing * straight_transmittance(make_bsdf(surface, direction, clear_eta(surface, medium, beyond)));
    }
    path.shadow_light = path.shadow_light * passing;
    path.shadow_alone = path.shadow_alone * passing;
    path.shadow_other = path.shadow_other * passing;
    shorten_shadow(surface);
  }

  // Adds the light of a shadow ray that reached its light.
  inline void add_shadow_light() {
    vec3 passing = medium_transmittance(current_medium(path.shadow_media), path.shadow_length);
    path.radiance += path.shadow_light * passing;
    path.alone_radiance += path.shadow_alone * passing;
    path.other_radiance += path.shadow_other * passing;
  }

  // --- a shadow ray

  // The contribution of a light source to the path without occlusion, over its pdf.
  inline vec3 unshadowed_light(PathSettings settings, Bsdf bsdf, LightSample light) {
    BsdfValue scattered = bsdf_value(bsdf, light.direction);
    float weight = 1.0f;
    if (light.pdf > 0.0f) weight = 1.0f / light.pdf;
    if (light.pdf > 0.0f && settings.light_sampling == kLightSamplingBoth) {
      weight = weight * power_heuristic(light.pdf, scattered.pdf);
    }
    return light.radiance * scattered.value * weight;
  }

  // Sets the shadow ray. Both ends are offset from their surfaces: it misses nothing between them, and neither surface
  // stops it. beyond: the media on the surface's other side.
  inline void shadow_towards(Surface surface, vec3 direction, float distance, vec3 end, Media beyond) {
    bool through = dot(direction, surface.geometric) < 0.0f;
    path.shadow_ray.origin = offset_point(surface.position, through ? -surface.geometric : surface.geometric);
    path.shadow_ray.direction = direction;
    path.shadow_length = distance;
    path.shadow_media = path.media;
    if (through) path.shadow_media = beyond;
    if (distance < kFarAway) end_shadow_at(end);
    path.shadow_pending = path.shadow_length > 0.0f;
  }

  inline Receiver receiver_of(Surface surface) {
    bool both_sides = surface.transmission > 0.0f || (surface.layered && surface_layers.diffuse_transmission > 0.0f);
    Receiver receiver;
    receiver.position = surface.position;
    receiver.normal = both_sides ? vec3(0.0f) : surface.normal;
    return receiver;
  }

  // Sets a shadow ray towards a light. If several lights are picked, it chooses one in proportion to its unoccluded
  // contribution.
  // Source: Talbot, Cline and Egbert, "Importance Resampling for Global Illumination", 2005.
  inline void aim_at_light(PathSettings settings, Surface surface, Bsdf bsdf, Media beyond) {
    int candidates = min(scene_light_pick_count(), path.bounce == 0 ? kLightCandidates : 1);
    if (candidates == 0) return;
    float draw = path_random(kCandidatePair).x;
    float total = 0.0f;
    LightSample chosen = no_light();
    vec3 chosen_light = vec3(0.0f);
    float chosen_brightness = 0.0f;
    Receiver receiver = receiver_of(surface);
    for (int i = 0; i < candidates; i++) {
      uint pair = kLightPair + 3u * uint(i);
      LightSample light = sample_light(receiver, path_random(pair), path_random(pair + 1u), path_random(pair + 2u));
      if (!light.valid) continue;
      vec3 arriving = unshadowed_light(settings, bsdf, light);
      float brightness = luminance(arriving) * light.chance;
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
      vec3 for_other = unshadowed_light(settings, this_step.other, chosen);
      float own = luminance(chosen_light);
      float own_share = own / (own + path.other_density * luminance(for_other));
      path.shadow_other = for_other * scale * (path.other_density * own_share);
      path.shadow_light = path.shadow_light * own_share;
    }
    shadow_towards(surface, chosen.direction, chosen.distance, chosen.end, beyond);
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif
