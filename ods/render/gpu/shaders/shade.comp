// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Advances the path of a slot by one step, with what `trace` has found. A path that ends is added to the sums. Each
// large function of the kernel is called in one place: drivers inline all of them.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "ods/render/gpu/shaders/kernel.glsl"
#include "ods/render/gpu/shaders/slot.glsl"
#include "ods/render/gpu/shaders/sums.glsl"

Status advance(uint slot, Status status) {
  int phase = status.phase;
  bool walks = phase == kWalking || phase == kInGlass;
  straight_solids = gpu_view.straight_solids == 1;
  ray_time = 0.5;
  uvec4 found = chunk_of(slot, kHitTriangles);
  bool is_blocked = found.z == 1u;
  bool is_depth = phase == kDepthTraced;
  bool shades = true;
  if (walks || is_depth) {
    load_path(slot, status.other_pixel >= 0);
  } else {
    load_started_path(slot);
  }
  if (walks) {
    bool arrives = path.shadow_pending && (phase == kInGlass || !is_blocked);
    if (arrives && status.clear > 0) {
      Hit glass = hit_of(slot, kGlassHit, found.y);
      if (glass.t >= 0.0 && glass.t < path.shadow_length) {
        pass_shadow(glass);
        status.clear -= 1;
      } else {
        status.clear = 0;
      }
    }
    phase = arrives && status.clear > 0 ? kInGlass : kWalking;
    if (phase == kWalking && arrives) add_shadow_light();
    if (phase == kWalking) path.shadow_pending = false;
    shades = phase == kWalking && path.alive;
  } else if (phase == kAnswered && !is_blocked) {
    vec4 other = floats_of(slot, kShadowWay);
    share_path(other.xyz, other.w);
  } else {
    status.other_pixel = -1;
  }
  if (shades) {
    PathSettings settings;
    settings.bounces = is_depth ? 0 : gpu_view.bounces;
    settings.light_sampling = gpu_view.light_sampling;
    settings.keep_vertices = false;
    settings.clamp = gpu_view.clamp;
    shade(hit_of(slot, kHit, found.x), settings);
    phase = is_depth ? kDepth : kWalking;
  }
  bool ends = !path.alive && !path.shadow_pending;
  if (is_depth ? !path.alive || path.depth >= 0.0 : ends) {
    Place place = place_of(slot);
    int at = (place.eye_index * gpu_view.height + place.y) * gpu_view.width + place.x;
    if (is_depth) {
      gpu_view.depth.at[at] = path.depth < 0.0 ? gpu_view.far_depth : path.caught ? -path.depth : path.depth;
      phase = kDepthKnown;
    } else {
      if (status.other_pixel >= 0) add_shared(status.other_pixel);
      add_own(at);
      phase = kStarting;
    }
  } else {
    store_path(slot, status.other_pixel >= 0);
  }
  status.phase = phase;
  return status;
}

void main() {
  int list = this_round(kShadeLists);
  empty_list(this_round(kTraceLists));
  int next = kNoList;
  uint slot = 0u;
  if (gl_GlobalInvocationID.x < length_of(list)) {
    slot = listed_slot(list);
    Status status = advance(slot, status_of(slot));
    put_status(slot, status);
    bool starts = status.phase == kStarting || status.phase == kDepthKnown;
    next = next_round(starts ? kBeginLists : kTraceLists);
  }
  append(slot, next);
}
