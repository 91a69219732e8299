// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Follows the rays that a slot waits for.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "ods/render/gpu/shaders/kernel.glsl"
#include "ods/render/gpu/shaders/slot.glsl"

Status trace(uint slot, Status status) {
  int phase = status.phase;
  bool asks = phase == kAsking;
  // The parts of the path that decide what its rays meet.
  straight_solids = gpu_view.straight_solids == 1;
  uvec4 progress = chunk_of(slot, kProgress);
  path.bounce = int(progress.x);
  path.passed = int(progress.y);
  path.seed = chunk_of(slot, kRayOrigin).w;
  path.index = chunk_of(slot, kRayWay).w;
  path.caught = kHasCatchers && (progress.w & kIsCaught) != 0u;

  uvec4 found = chunk_of(slot, kHitTriangles);
  bool has_shadow = asks || (phase == kWalking && (progress.w & kShadowPending) != 0u);
  bool follows_glass = phase == kInGlass;
  Ray shadow_ray = ray_of(slot, kShadowOrigin);
  if (has_shadow) {
    float distance = floats_of(slot, kShadowOrigin).w;
    Passage passage = along_tree(shadow_ray, distance, asks ? kPathRay : kShadowRay);
    found.z = passage.blocked ? 1u : 0u;
    status.clear = passage.clear;
    if (asks) status.phase = kAnswered;
    follows_glass = phase == kWalking && !passage.blocked && passage.clear > 0;
  }
  bool follows_path =
      phase == kFirstHit || phase == kDepth || (phase == kWalking && (progress.w & kAlive) != 0u);
  for (int ray = 0; ray < 2; ray++) {
    bool is_glass = ray == 1;
    if (is_glass ? !follows_glass : !follows_path) continue;
    Ray along = shadow_ray;
    if (!is_glass) along = ray_of(slot, kRayOrigin);
    Hit hit = nearest_in_tree(along, is_glass ? kShadowRay : phase == kDepth ? kHalfAlphaRay : kPathRay);
    put_hit(slot, is_glass ? kGlassHit : kHit, hit);
    if (is_glass) {
      found.y = uint(hit.triangle);
    } else {
      found.x = uint(hit.triangle);
    }
  }
  if (phase == kDepth) status.phase = kDepthTraced;
  put_chunk(slot, kHitTriangles, found);
  return status;
}

void main() {
  int list = this_round(kTraceLists);
  empty_list(this_round(kBeginLists));
  empty_list(next_round(kShadeLists));
  int next = kNoList;
  uint slot = 0u;
  if (gl_GlobalInvocationID.x < length_of(list)) {
    slot = listed_slot(list);
    Status status = trace(slot, status_of(slot));
    put_status(slot, status);
    next = status.phase == kFirstHit ? next_round(kBeginLists) : this_round(kShadeLists);
  }
  append(slot, next);
}
