// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A slot is a pixel of one eye that takes its samples one after the other. In each round, the stage `begin` starts
// samples and finds the counterparts of their first hits, the stage `trace` follows the rays that slots wait for, and
// the stage `shade` advances paths by one step. A slot of zeros is at the start.
const int kStarting = 0;     // for begin: starts the next sample
const int kFirstHit = 1;     // for trace, then begin: where path.ray ends, before anything is shaded
const int kAsking = 2;       // for trace: whether the other eye sees that place, to which path.shadow_ray leads
const int kAnswered = 3;     // for shade: `blocked` is the answer
const int kAlone = 4;        // for shade: the first hit has no counterpart
const int kWalking = 5;      // for trace, then shade: where path.ray ends, and what the shadow ray meets, if any
const int kInGlass = 6;      // for trace, then shade: where the shadow ray meets its next surface of clear glass
const int kDepth = 7;        // for trace: the ray through the pixel's centre, for its depth
const int kDepthTraced = 8;  // for shade: where it ends
const int kDepthKnown = 9;   // for begin: starts the first sample
const int kFinished = 10;

// A slot's data in chunks of 16 bytes. All slots' first chunks come first, then their second ones, and so on: threads
// of neighbouring slots read neighbouring memory, and a stage reads only the chunks that it needs.
const int kStatus = 0;      // phase, samples begun, surfaces of clear glass that the shadow ray has still to pass,
                            // the other eye's pixel that receives light from the path, or -1
const int kProgress = 1;    // bounce, passed, wave, flags
const int kRayOrigin = 2;   // path.ray.origin, seed
const int kRayWay = 3;      // path.ray.direction, index
const int kShadowOrigin = 4;  // path.shadow_ray.origin, shadow_length
const int kShadowWay = 5;     // path.shadow_ray.direction, other_density until the counterpart is known
const int kHit = 6;           // where path.ray ends: t, u, v, instance
const int kGlassHit = 7;      // where the shadow ray meets clear glass
const int kHitTriangles = 8;  // those of both hits; 1 if the shadow ray, or the ray to the counterpart, is blocked
const int kThroughput = 9;    // and pdf
const int kRadiance = 10;     // and travelled
const int kReceiver = 11;     // its position, own_share
const int kFacing = 12;       // the receiver's normal, other_pdf
const int kMedia = 13;
const int kShadowMedia = 14;
const int kCounts = 15;       // of both media, depth, alone_ratio
const int kShadowLight = 16;  // one chunk of three numbers each
const int kShadowOther = 17;
const int kShadowAlone = 18;
const int kOtherWay = 19;  // other_direction, other_density
const int kOtherRatio = 20;
const int kOtherRadiance = 21;
const int kAloneRadiance = 22;
const int kNormal = 23;
const int kAlbedo = 24;
const int kCaught = 25;  // unblocked, light_with, light_without: of a path that a shadow catcher has met

// The flags of a path.
const uint kAlive = 1u;
const uint kShadowPending = 2u;
const uint kBothSee = 4u;
const uint kMirrored = 8u;
const uint kIsCaught = 16u;

layout(buffer_reference, std430, buffer_reference_align = 16) buffer Slots { uvec4 at[]; };

#include "ods/render/gpu/shaders/lists.glsl"

uvec4 chunk_of(uint slot, int chunk) { return gpu_view.slots.at[uint(chunk) * gpu_view.slot_count + slot]; }
void put_chunk(uint slot, int chunk, uvec4 value) {
  gpu_view.slots.at[uint(chunk) * gpu_view.slot_count + slot] = value;
}

struct Status {
  int phase;
  int taken;
  int clear;
  int other_pixel;
};

Status status_of(uint slot) {
  ivec4 chunk = ivec4(chunk_of(slot, kStatus));
  return Status(chunk.x, chunk.y, chunk.z, chunk.w);
}

void put_status(uint slot, Status status) {
  put_chunk(slot, kStatus, uvec4(ivec4(status.phase, status.taken, status.clear, status.other_pixel)));
}

uvec4 packed(vec3 values, float last) { return floatBitsToUint(vec4(values, last)); }
uvec4 packed(vec3 values, uint last) { return uvec4(floatBitsToUint(values), last); }
vec4 floats_of(uint slot, int chunk) { return uintBitsToFloat(chunk_of(slot, chunk)); }

void put_hit(uint slot, int chunk, Hit hit) {
  put_chunk(slot, chunk, uvec4(floatBitsToUint(vec3(hit.t, hit.u, hit.v)), uint(hit.instance)));
}

Hit hit_of(uint slot, int chunk, uint triangle) {
  uvec4 words = chunk_of(slot, chunk);
  Hit hit;
  hit.t = uintBitsToFloat(words.x);
  hit.u = uintBitsToFloat(words.y);
  hit.v = uintBitsToFloat(words.z);
  hit.instance = int(words.w);
  hit.triangle = int(triangle);
  return hit;
}

Ray ray_of(uint slot, int origin) {
  Ray ray;
  ray.origin = floats_of(slot, origin).xyz;
  ray.direction = floats_of(slot, origin + 1).xyz;
  return ray;
}

uvec4 packed(Media media) {
  return uvec4(ivec4(media.material[0], media.material[1], media.material[2], media.material[3]));
}

Media media_from(ivec4 materials, int count) {
  Media media;
  media.material[0] = materials.x;
  media.material[1] = materials.y;
  media.material[2] = materials.z;
  media.material[3] = materials.w;
  media.count = count;
  return media;
}

// Stores what a path has after its start; the rest follows from it (load_started_path()).
void store_started_path(uint slot) {
  put_chunk(slot, kProgress, uvec4(0u, 0u, uint(path.wave), kAlive));
  put_chunk(slot, kRayOrigin, packed(path.ray.origin, path.seed));
  put_chunk(slot, kRayWay, packed(path.ray.direction, path.index));
}

void load_started_path(uint slot) {
  uvec4 origin = chunk_of(slot, kRayOrigin);
  uvec4 way = chunk_of(slot, kRayWay);
  Ray ray;
  ray.origin = uintBitsToFloat(origin.xyz);
  ray.direction = uintBitsToFloat(way.xyz);
  start_path(ray, media_from(gpu_view.media, gpu_view.media_count), origin.w, way.w);
}

// is_shared: the path contributes light to the other eye.
void store_path(uint slot, bool is_shared) {
  put_chunk(slot, kProgress, uvec4(uint(path.bounce), uint(path.passed), uint(path.wave),
                                   (path.alive ? kAlive : 0u) | (path.shadow_pending ? kShadowPending : 0u) |
                                       (path.both_see ? kBothSee : 0u) | (path.mirrored ? kMirrored : 0u) |
                                       (path.caught ? kIsCaught : 0u)));
  put_chunk(slot, kRayOrigin, packed(path.ray.origin, path.seed));
  put_chunk(slot, kRayWay, packed(path.ray.direction, path.index));
  put_chunk(slot, kThroughput, packed(path.throughput, path.pdf));
  put_chunk(slot, kRadiance, packed(path.radiance, path.travelled));
  put_chunk(slot, kReceiver, packed(path.receiver.position, path.own_share));
  put_chunk(slot, kFacing, packed(path.receiver.normal, path.other_pdf));
  put_chunk(slot, kMedia, packed(path.media));
  put_chunk(slot, kCounts, uvec4(uint(path.media.count), uint(path.shadow_media.count), floatBitsToUint(path.depth),
                                 floatBitsToUint(path.alone_ratio)));
  if (kHasCatchers && path.caught) {
    put_chunk(slot, kCaught, packed(vec3(path.unblocked, path.light_with, path.light_without), 0u));
  }
  if (path.shadow_pending || path.caught) {
    put_chunk(slot, kShadowOrigin, packed(path.shadow_ray.origin, path.shadow_length));
    put_chunk(slot, kShadowWay, packed(path.shadow_ray.direction, 0u));
    put_chunk(slot, kShadowMedia, packed(path.shadow_media));
    put_chunk(slot, kShadowLight, packed(path.shadow_light, 0u));
    put_chunk(slot, kShadowAlone, packed(path.shadow_alone, 0u));
  }
  if (is_shared) {
    put_chunk(slot, kShadowOther, packed(path.shadow_other, 0u));
    put_chunk(slot, kOtherWay, packed(path.other_direction, path.other_density));
    put_chunk(slot, kOtherRatio, packed(path.other_ratio, 0u));
    put_chunk(slot, kOtherRadiance, packed(path.other_radiance, 0u));
  }
  if (gpu_view.has_alone == 1) put_chunk(slot, kAloneRadiance, packed(path.alone_radiance, 0u));
  if (gpu_view.has_layers == 1) {
    put_chunk(slot, kNormal, packed(path.normal, 0u));
    put_chunk(slot, kAlbedo, packed(path.albedo, 0u));
  }
}

void load_path(uint slot, bool is_shared) {
  load_started_path(slot);
  uvec4 progress = chunk_of(slot, kProgress);
  path.bounce = int(progress.x);
  path.passed = int(progress.y);
  path.wave = int(progress.z);
  path.alive = (progress.w & kAlive) != 0u;
  path.shadow_pending = (progress.w & kShadowPending) != 0u;
  path.both_see = (progress.w & kBothSee) != 0u;
  path.mirrored = (progress.w & kMirrored) != 0u;
  path.caught = kHasCatchers && (progress.w & kIsCaught) != 0u;
  vec4 four = floats_of(slot, kThroughput);
  path.throughput = four.xyz, path.pdf = four.w;
  four = floats_of(slot, kRadiance);
  path.radiance = four.xyz, path.travelled = four.w;
  four = floats_of(slot, kReceiver);
  path.receiver.position = four.xyz, path.own_share = four.w;
  four = floats_of(slot, kFacing);
  path.receiver.normal = four.xyz, path.other_pdf = four.w;
  uvec4 counts = chunk_of(slot, kCounts);
  path.media = media_from(ivec4(chunk_of(slot, kMedia)), int(counts.x));
  path.depth = uintBitsToFloat(counts.z);
  path.alone_ratio = uintBitsToFloat(counts.w);
  if (path.caught) {
    vec4 light = floats_of(slot, kCaught);
    path.unblocked = light.x, path.light_with = light.y, path.light_without = light.z;
  }
  if (path.shadow_pending || path.caught) {
    path.shadow_ray = ray_of(slot, kShadowOrigin);
    path.shadow_length = floats_of(slot, kShadowOrigin).w;
    path.shadow_media = media_from(ivec4(chunk_of(slot, kShadowMedia)), int(counts.y));
    path.shadow_light = floats_of(slot, kShadowLight).xyz;
    path.shadow_alone = floats_of(slot, kShadowAlone).xyz;
    path.shadow_other = vec3(0.0);
  }
  if (is_shared) {
    path.shadow_other = floats_of(slot, kShadowOther).xyz;
    four = floats_of(slot, kOtherWay);
    path.other_direction = four.xyz, path.other_density = four.w;
    path.other_ratio = floats_of(slot, kOtherRatio).xyz;
    path.other_radiance = floats_of(slot, kOtherRadiance).xyz;
  }
  if (gpu_view.has_alone == 1) path.alone_radiance = floats_of(slot, kAloneRadiance).xyz;
  if (gpu_view.has_layers == 1) {
    path.normal = floats_of(slot, kNormal).xyz;
    path.albedo = floats_of(slot, kAlbedo).xyz;
  }
}

// The slot's pixel.
struct Place {
  int eye_index;  // in PictureSamples
  int block;
  int x;
  int y;
  bool exists;  // blocks reach beyond the picture's edges
};

Place place_of(uint slot) {
  int at = call.first_block + int(slot / uint(kGroupSize));
  if (call.is_reversed == 1) at = gpu_view.blocks * (gpu_view.second_eye < 0 ? 1 : 2) - 1 - at;
  int within = int(slot % uint(kGroupSize));
  Place place;
  place.eye_index = at / gpu_view.blocks;
  place.block = at - place.eye_index * gpu_view.blocks;
  int row = place.block / gpu_view.columns;
  place.x = (place.block - row * gpu_view.columns) * 8 + within % 8;
  place.y = row * 8 + within / 8;
  place.exists = place.x < gpu_view.width && place.y < gpu_view.height;
  return place;
}
