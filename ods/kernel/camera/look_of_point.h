// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// World point -> the ray that meets it, by iteration: for cameras whose eyes leave the circle's plane, where the closed
// forms of project.h do not hold.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/camera/camera.h"
namespace ods {
#endif

// The ray that meets a point, as the camera builds it.
struct PointLook {
  vec3 direction;  // of the projection, after kShift's turn and before toe-in
  vec3 origin;     // from the circle's centre; both in the camera's frame
  bool found;      // false: no ray meets the point, or several do
};

// point: from the circle's centre, in the camera's frame. nearness: 1; or 0 for a point at infinity in that direction.
// A fixed-point iteration that is right for every camera: take the eye's place for the direction found so far, and look
// from there to the point. It converges because the eye moves by less than its distance to the point. Aitken's
// relaxation makes it fast, and lets it converge on maps so steep that the eye moves by more.
inline PointLook look_of_point(Camera camera, int eye, vec3 point, float nearness) {
  PointLook look;
  look.direction = vec3(0.0f, 0.0f, -1.0f);
  look.origin = vec3(0.0f);
  if (length(point) > 0.0f) look.direction = normalize(point);
  vec3 move = vec3(0.0f);
  float step = 1.0f;
  float off = 1.0f;
  for (int i = 0; i < 48 && off > 2e-7f; i++) {
    EyeOffset offset = eye_offset(camera, eye, look_about_axis(camera, look_along(look.direction)));
    look.origin = offset.stereo + offset.neck;
    vec3 ray = point - look.origin * nearness;
    vec3 next = ray * (1.0f / max(length(ray), 1e-30f));
    // C d - E points along the ray, and E is perpendicular to d.
    float c = camera.convergence_distance;
    if (camera.convergence == kToeIn) next = next * sqrt(c * c + dot(offset.stereo, offset.stereo)) + offset.stereo;
    vec3 last = move;
    move = normalize(next) - look.direction;
    vec3 change = move - last;
    if (i > 0) step = clamp(-step * dot(last, change) / max(dot(change, change), 1e-30f), 0.1f, 2.0f);
    look.direction = normalize(look.direction + move * step);
    off = length(move);
  }
  look.found = off < 1e-5f;
  return look;
}

#ifdef __cplusplus
}  // namespace ods
#endif
