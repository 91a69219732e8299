// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a path knows between its steps (ods/kernel/path.h), and the numbers that steer it.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/medium.h"
namespace ods {
#endif

const int kLightSamplingBoth = 0;
const int kLightSamplingLightsOnly = 1;
const int kLightSamplingBsdfOnly = 2;

struct PathSettings {
  int bounces;  // a path has at most bounces + 1 segments
  int light_sampling;
  bool keep_vertices;  // for whoever fills a light cache
  float clamp;         // the most that light brings which has met two surfaces or more: mean of R, G and B; 0: any
};

// Where light can be kept in the light cache, and of which albedo.
struct CachePlace {
  vec3 position;
  vec3 normal;  // of the triangle, on the side that the light leaves
  vec3 albedo;
  float cell;  // size of the larger cell, metres; 0: nothing is kept here
};

struct PathState {
  Ray ray;
  vec3 throughput;
  vec3 radiance;
  bool alive;
  int bounce;
  int passed;  // surfaces passed through since the last bounce
  float pdf;   // of the ray's direction; 0: the camera or a mirror chose it, and light sampling could not have found it
  float travelled;  // distance from the last bounce to the ray's origin
  Media media;
  int wave;         // the one colour of a path that dispersion has split; -1: all
  int chosen_wave;  // at a surface that splits colours: the one that the path keeps if it is refracted; else -1
  uint seed;        // of the pixel
  uint index;       // of the sample

  Ray shadow_ray;
  float shadow_length;
  Media shadow_media;  // where it is
  vec3 shadow_light;
  bool shadow_pending;

  // Both eyes from one path. What a sample adds to the other eye's pixel is in units of this eye's samples: it needs no
  // further weight.
  bool both_see;         // the other eye sees the first surface, too
  vec3 other_direction;  // from the other eye to it
  float other_density;   // of the other eye's samples there, over this eye's
  Bsdf other;            // of the first surface
  float own_share;       // of the light after the first surface, this eye's
  vec3 other_ratio;      // light for the other eye over light for this one; 0: not shared
  float alone_ratio;     // light if it were not shared, over light for this eye
  float other_pdf;       // like pdf, as if the other eye had chosen the ray's direction
  vec3 other_radiance;   // for the other eye's pixel
  vec3 alone_radiance;   // for this one if nothing were shared: tells how much a single path varies
  vec3 shadow_other;     // like shadow_light
  vec3 shadow_alone;

  bool caught;          // the first surface is a catcher; the next three fields belong to such a path
  float unblocked;      // 0: an object that is no catcher, emitter or clear glass stands before the light; else 1
  float light_without;  // luminance that arrives if only catchers and emitters are present
  float light_with;     // luminance that arrives with the whole scene present

  // PathSettings::keep_vertices: the surface that shade() met last, before it scatters the path.
  CachePlace vertex;
  int vertex_bounce;  // -1: shade() met none
  vec3 vertex_throughput;
  vec3 vertex_radiance;  // what the path had found by then

  // The first hit, for the layers beside the picture.
  float depth;  // along the camera ray from its own origin; negative: the ray hit nothing
  vec3 normal;
  vec3 albedo;
};

const int kMaxPassed = 1024;
const uint kPassedStride = 256u;  // bounces for which paths have random numbers of their own after each such surface

// A ray scattered with a smaller pdf than this may have gone almost anywhere: the reduced copies of textures are sharp
// enough for what it hits, and they fit the processor's cache. The full ones cost a fifth of the time on the atrium.
const float kBroadPdf = 2.0f;

// The camera sees a kDimmedLamp no brighter than this luminance: near display white at the
// exposure of a room that it lights.
const float kSeenLamp = 0.6f;

// Paths with a throughput below this may end at random. Lower values cost time, higher ones noise: of 1, 1/2, 1/4 and
// none, 1/4 reaches a given noise soonest on interiors (./run bench, equal noise).
const float kRouletteThreshold = 0.25f;

// The number of lights that the first surface considers for its shadow ray; it chooses one by the light that it would
// bring. A room with several lamps reaches equal noise in four fifths of the time that a single candidate takes; deeper
// surfaces gain nothing.
const int kLightCandidates = 3;

// The pairs of random numbers of a path: pair 0 places the sample in its pixel, one places it on the lens, one in the
// time that the shutter is open, then the pairs below follow for each bounce.
const uint kPixelPair = 0u;
const uint kLensPair = 0xffffffffu;
const uint kTimePair = 0xfffffffeu;
const uint kScatterPair = 1u;  // lobe, roulette
const uint kDirectionPair = 2u;
const uint kCandidatePair = 3u;  // which candidate; which colour dispersion leaves
const uint kLightPair = 4u;      // from here on three per candidate: light, cell of an environment, point
const uint kPairsPerBounce = 3u + 3u * uint(kLightCandidates);

// Which ray calls alpha_draw(): the path's next ray, its shadow ray, or a ray that hits every surface of at least one
// half alpha and no other.
const int kPathRay = 0;
const int kShadowRay = 1;
const int kHalfAlphaRay = 2;

#ifdef __cplusplus
}  // namespace ods
#endif
