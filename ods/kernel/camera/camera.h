// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Eye and image position -> ray: the omni-directional stereo camera, a pure function.
// Source: Google, "Rendering Omni-directional Stereo Content", Ray tracing the ODS projection. With no pole merge it is
// that model exactly; the merges scale its viewing circle by a factor of the elevation.
//
// Image positions: u runs 0..1 from left to right, v 0..1 from top to bottom of one eye's picture; (0.5, 0.5) looks
// ahead. Positions outside are legal: u wraps, and v runs on over the pole, where the formula itself continues into the
// picture of the other eye half a turn away, as a wide pixel filter needs.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/math.h"
namespace ods {
#endif

const float kPi = 3.14159265358979f;

const int kLeft = 0;
const int kRight = 1;
const int kMono = 2;

const int kMergeNone = 0;
const int kMergeLinear = 1;
const int kMergeCosine = 2;
const int kMergeSmoothstep = 3;

// Elevations in radians from the horizon towards the pole, start < end.
struct PoleMerge {
  int mode;
  float start;
  float end;
  float exponent;
};

struct Camera {
  vec3 center;  // of the viewing circle, which lies in the plane of right and back
  vec3 right;   // an orthonormal, right-handed frame
  vec3 up;
  vec3 back;
  float ipd;
  PoleMerge top;
  PoleMerge bottom;
};

struct Ray {
  vec3 origin;
  vec3 direction;  // unit length
};

// The share of the viewing circle's radius that is left at an elevation (radians, 0 at the horizon .. pi/2).
inline float merge_factor(PoleMerge merge, float elevation) {
  if (merge.mode == kMergeNone) return 1.0f;
  float t = clamp((elevation - merge.start) / (merge.end - merge.start), 0.0f, 1.0f);
  float left = 1.0f - t;
  if (merge.mode == kMergeCosine) left = max(0.0f, cos(t * (0.5f * kPi)));
  if (merge.mode == kMergeSmoothstep) left = 1.0f - t * t * (3.0f - 2.0f * t);
  return merge.exponent == 1.0f ? left : pow(left, merge.exponent);
}

// Half the distance between the eyes for rays of elevation phi. Beyond a pole the elevation falls again.
inline float eye_radius(Camera camera, float phi) {
  float elevation = abs(phi);
  if (elevation > 0.5f * kPi) elevation = abs(kPi - elevation);
  float factor = phi < 0.0f ? merge_factor(camera.bottom, elevation) : merge_factor(camera.top, elevation);
  return 0.5f * camera.ipd * factor;
}

inline float eye_side(int eye) {
  return eye == kLeft ? -1.0f : eye == kRight ? 1.0f : 0.0f;
}

inline Ray camera_ray(Camera camera, int eye, vec2 uv) {
  float theta = (uv.x - 0.5f) * (2.0f * kPi);
  float phi = (0.5f - uv.y) * kPi;
  float sin_theta = sin(theta);
  float cos_theta = cos(theta);
  float cos_phi = cos(phi);
  float offset = eye_side(eye) * eye_radius(camera, phi);
  Ray ray;
  ray.origin = camera.center + (offset * cos_theta) * camera.right + (offset * sin_theta) * camera.back;
  ray.direction = (sin_theta * cos_phi) * camera.right + sin(phi) * camera.up - (cos_theta * cos_phi) * camera.back;
  return ray;
}

#ifdef __cplusplus
static_assert(sizeof(PoleMerge) == 16 && sizeof(Camera) == 84);
}  // namespace ods
#endif
