// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Starts the samples of a slot, and finds the counterparts of their first hits in the other eye.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "ods/render/gpu/shaders/kernel.glsl"
#include "ods/render/gpu/shaders/slot.glsl"

bool is_noisy(int x, int y) {
  GpuBlock block = gpu_view.pass.at[y / 8 * gpu_view.columns + x / 8];
  return (block.noisy >> uint((x + y) & 1) & 1u) == 1u;
}

// The weight of a pixel's samples in the pass; 0 if it is clean.
float weight_in_pass(int x, int y) {
  return is_noisy(x, y) ? gpu_view.pass.at[y / 8 * gpu_view.columns + x / 8].weight : 0.0;
}

vec2 sample_position(Place place, uint seed, uint index) {
  return filtered_position(gpu_view.filter_shape, place.x, place.y, gpu_view.width, gpu_view.height,
                           random_pair(seed, index, kPixelPair));
}

// The slot's first hit is known: asks for its counterpart in the other eye, if there may be one.
Status find_counterpart(uint slot, Place place, int eye, uint seed, Status status) {
  status.phase = kAlone;
  float t = floats_of(slot, kHit).x;
  if (gpu_view.shares == 1 && t >= 0.0) {
    vec2 size = vec2(float(gpu_view.width), float(gpu_view.height));
    Ray ray = ray_of(slot, kRayOrigin);
    vec2 uv = sample_position(place, seed, chunk_of(slot, kRayWay).w);
    Counterpart other =
        counterpart_of(gpu_view.camera, gpu_view.filter_shape, size, eye, vec2(float(place.x), float(place.y)), uv,
                       ray.direction, ray.origin + ray.direction * t);
    float theirs = other.exists ? weight_in_pass(other.x, other.y) : 0.0;
    if (theirs > 0.0) {
      float length = other.distance * (1.0 - 1e-4);  // just short of the surface
      float density = other.density * theirs / weight_in_pass(place.x, place.y);
      put_chunk(slot, kShadowOrigin, packed(other.origin, length));
      put_chunk(slot, kShadowWay, packed(other.direction, density));
      status.other_pixel = ((1 - place.eye_index) * gpu_view.height + other.y) * gpu_view.width + other.x;
      status.phase = kAsking;
    }
  }
  return status;
}

// Starts the slot's next sample, or the ray for its depth. After the last one, and where the picture is empty, the slot
// is finished.
Status start_sample(uint slot, Place place, int eye, uint seed, Status status) {
  GpuBlock block = gpu_view.pass.at[place.block];
  bool is_depth =
      status.phase == kStarting && status.taken == 0 && call.takes_depth == 1 && gpu_view.has_layers == 1;
  int index = block.first + status.taken;
  vec2 size = vec2(float(gpu_view.width), float(gpu_view.height));
  vec2 home = (vec2(float(place.x), float(place.y)) + vec2(0.5)) / size;
  vec2 uv = home;
  vec2 lens = vec2(0.0);
  if (!is_depth) {
    uv = sample_position(place, seed, uint(index));
    if (gpu_view.camera.lens_radius > 0.0) lens = random_pair(seed, uint(index), kLensPair);
  }
  Ray ray = sample_ray(gpu_view.camera, eye, home, uv, lens);
  bool is_empty = ray.direction == vec3(0.0);
  if (is_empty && is_depth) {
    gpu_view.depth.at[(place.eye_index * gpu_view.height + place.y) * gpu_view.width + place.x] = gpu_view.far_depth;
  }
  if (is_empty || (!is_depth && index >= block.last)) {
    status.phase = kFinished;
    return status;
  }
  start_path(ray, media_from(gpu_view.media, gpu_view.media_count), seed, is_depth ? 0u : uint(index));
  if (is_depth) {
    store_path(slot, false);
  } else {
    store_started_path(slot);
  }
  status.phase = is_depth ? kDepth : kFirstHit;
  status.other_pixel = -1;
  if (!is_depth) status.taken += 1;
  return status;
}

Status begin(uint slot, Status status) {
  Place place = place_of(slot);
  if (!place.exists || !is_noisy(place.x, place.y)) {
    status.phase = kFinished;
    return status;
  }
  int eye = place.eye_index == 0 ? gpu_view.first_eye : gpu_view.second_eye;
  uint seed = hash_pair(hash_pair(gpu_view.seed, uint(eye)), uint(place.y * gpu_view.width + place.x));
  if (status.phase == kFirstHit) return find_counterpart(slot, place, eye, seed, status);
  return start_sample(slot, place, eye, seed, status);
}

void main() {
  int list = this_round(kBeginLists);
  int next = kNoList;
  uint slot = gl_GlobalInvocationID.x;
  if (call.is_first == 1 || slot < length_of(list)) {
    if (call.is_first == 0) slot = listed_slot(list);
    Status status = begin(slot, status_of(slot));
    put_status(slot, status);
    if (status.phase != kFinished) next = this_round(status.phase == kAlone ? kShadeLists : kTraceLists);
  }
  append(slot, next);
}
