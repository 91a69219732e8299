// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pole merge: the fraction of the viewing circle's radius that remains at an elevation. The curves are taken from
// existing systems, which docs/cameras.md lists.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/camera/angles.h"
namespace ods {
#endif

const int kMergeNone = 0;
const int kMergeLinear = 1;
const int kMergeCosine = 2;  // POV-Ray page, OSPRay, Arnold, Cycles
const int kMergeSmoothstep = 3;
const int kMergeGaussian = 4;      // eVRydayVR
const int kMergePower = 5;         // Mandelbulber: 1 - t^exponent
const int kMergeTiltBrush = 6;     // Google's Unity kit: never below 0.84
const int kMergeMap = 7;           // a lat-long picture, as in shader mode of the VR camera for Arnold
const int kMergeSmootherstep = 8;  // Perlin's curve: its second derivative is continuous at both ends
const int kMergeCount = 9;

// Elevations in radians from the horizon towards the pole, start < end. t is 0..1 between them.
struct PoleMerge {
  int mode;
  float start;
  float end;
  float exponent;  // the curve is raised to this power; for kMergePower, t is
};

// The fraction that remains at an elevation (radians, 0 at the horizon .. pi/2). Returns 1 for kMergeMap, which is not
// a function of elevation.
inline float merge_factor(PoleMerge merge, float elevation) {
  if (merge.mode == kMergeNone || merge.mode == kMergeMap) return 1.0f;
  float t = clamp((elevation - merge.start) / (merge.end - merge.start), 0.0f, 1.0f);
  if (merge.mode == kMergePower) return 1.0f - pow(t, merge.exponent);
  float left = 1.0f - t;
  if (merge.mode == kMergeCosine) left = max(0.0f, cos_of(t * (0.5f * kPi)));
  if (merge.mode == kMergeSmoothstep) left = 1.0f - t * t * (3.0f - 2.0f * t);
  if (merge.mode == kMergeSmootherstep) left = left * left * left * (left * (6.0f * left - 15.0f) + 10.0f);
  if (merge.mode == kMergeGaussian) left = (exp(-t * t) - exp(-1.0f)) / (1.0f - exp(-1.0f));
  if (merge.mode == kMergeTiltBrush) left = 1.0f - sin_of(t * (0.5f / kPi));
  return merge.exponent == 1.0f ? left : pow(max(left, 0.0f), merge.exponent);
}

#ifdef __cplusplus
}  // namespace ods
#endif
