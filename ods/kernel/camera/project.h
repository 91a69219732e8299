// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// World point -> image position in each eye: the inverse of camera_ray().
//
// In the camera's frame let rho be the point's distance from the vertical axis and alpha its azimuth. The ray that
// meets it starts on the viewing circle of radius r, touches that circle's tangent, and so
//   theta = alpha - side * asin(r / rho),   phi = atan(height / sqrt(rho^2 - r^2)).
// Without a merge r is half the ipd. With one, r depends on phi; the equation in phi has one root, since a circle that
// shrinks towards the poles never makes rays cross. It is found by bisection, except where r = ipd/2 cos(phi), which
// again has a closed form.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/camera/camera.h"
namespace ods {
#endif

struct ImagePosition {
  vec2 uv;      // both 0..1
  float depth;  // along the ray from its own origin
  bool seen;    // false: inside the viewing circle's cylinder, where no ray of this eye passes
};

// |phi| of the ray that meets a point at a height above (or below) the viewing circle's plane.
inline float merged_elevation(PoleMerge merge, float radius, float rho, float height) {
  if (merge.mode == kMergeCosine && merge.start == 0.0f && merge.exponent == 1.0f && merge.end > 0.4999f * kPi) {
    float b = radius * radius + rho * rho + height * height;
    float cos2 = 2.0f * rho * rho / (b + sqrt(max(b * b - 4.0f * radius * radius * rho * rho, 0.0f)));
    float cosine = sqrt(min(cos2, 1.0f));
    float r = radius * cosine;
    return atan(height, sqrt(max(rho * rho - r * r, 0.0f)));
  }
  float low = 0.0f;
  float high = 0.5f * kPi;
  for (int i = 0; i < 40; i++) {
    float middle = 0.5f * (low + high);
    float r = radius * merge_factor(merge, middle);
    float reach2 = rho * rho - r * r;
    bool too_low = reach2 < 0.0f || sin(middle) * sqrt(max(reach2, 0.0f)) < height * cos(middle);
    if (too_low) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return 0.5f * (low + high);
}

inline ImagePosition project_point(Camera camera, int eye, vec3 point) {
  vec3 p = point - camera.center;
  float x = dot(p, camera.right);
  float y = dot(p, camera.up);
  float ahead = -dot(p, camera.back);
  float rho = sqrt(x * x + ahead * ahead);
  float side = eye_side(eye);
  float r = side == 0.0f ? 0.0f : 0.5f * camera.ipd;
  PoleMerge merge = camera.top;
  if (y < 0.0f) merge = camera.bottom;
  if (merge.mode != kMergeNone && r > 0.0f) {
    float elevation = merged_elevation(merge, r, rho, abs(y));
    r = r * merge_factor(merge, elevation);
  }
  float reach = sqrt(max(rho * rho - r * r, 0.0f));
  float theta = atan(x, ahead) - side * asin(clamp(r / max(rho, 1e-30f), 0.0f, 1.0f));
  float phi = atan(y, reach);
  float u = 0.5f + theta * (0.5f / kPi);
  ImagePosition position;
  position.uv = vec2(u - floor(u), 0.5f - phi * (1.0f / kPi));
  position.depth = sqrt(reach * reach + y * y);
  position.seen = rho > r || (r == 0.0f && position.depth > 0.0f);
  return position;
}

#ifdef __cplusplus
}  // namespace ods
#endif
