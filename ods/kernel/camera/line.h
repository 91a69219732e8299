// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Line of sight -> position in a picture, for code that shows or converts pictures: it has the direction in which a
// viewer looks, not the point that is seen.
//
// A line of sight is identified by its direction alone: pictures with the same viewing circle and merge contain the
// same lines, and differ only in where they put them.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/camera/camera.h"
namespace ods {
#endif

// The ray that meets a point, as the camera builds it.
struct PointLook {
  vec3 direction;  // before the projection, after kShift's rotation and before toe-in, in the camera's frame
  vec3 origin;     // relative to the circle's centre, in the camera's frame
  bool found;      // false if no ray or several rays meet the point
};

// Finds the ray that meets a point. point: relative to the circle's centre, in the camera's frame. nearness: 1, or 0
// for a point at infinity in that direction.
// A fixed-point iteration that works for every camera: it places the eye for the current direction, then looks from
// there to the point. It converges because the eye moves by less than its distance to the point. Aitken's relaxation
// makes it fast, and makes it converge on maps so steep that the eye moves by more.
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

// The direction d' under which a toed-in picture stores the line of direction d: C d' minus the eye's offset is
// parallel to d. The offset's size depends on the elevation, through the merge: a few iterations find both.
inline vec3 toed_in_label(Camera camera, int eye, vec3 d) {
  if (has_head_tilt(camera)) return look_of_point(camera, eye, d, 0.0f).direction;
  float c = camera.convergence_distance;
  float height = dot(d, camera.axis);
  vec3 level = d - camera.axis * height;
  if (length(level) == 0.0f) return d;
  float phi = asin_of(clamp(height, -1.0f, 1.0f));
  float r = 0.0f;
  for (int i = 0; i < 8; i++) {
    r = 0.5f * camera.ipd * abs(eye_side(eye)) * merge_at(camera, d, phi);
    phi = asin_of(clamp(height * sqrt(1.0f + r * r / (c * c)), -1.0f, 1.0f));
  }
  vec2 rise = cos_sin(phi);
  float turn = -eye_side(eye) * atan_of(r, c * rise.x);
  return turn_about(normalize(level), camera.axis, turn) * rise.x + camera.axis * rise.y;
}

// The direction, in the camera's frame, that the projection maps to the place where an eye's picture shows the line of
// sight `direction` (camera's frame, unit length).
inline vec3 line_label(Camera camera, int eye, vec3 direction) {
  if (camera.convergence == kToeIn) return toed_in_label(camera, eye, direction);
  if (camera.convergence == kShift) return turn_about(direction, camera.axis, -shift_angle(camera, eye));
  return direction;
}

// Position in an eye's picture of the line of sight in a direction (camera's frame, any length but 0).
inline ImagePoint place_of_line(Camera camera, int eye, vec3 direction) {
  return place_of(camera.projection, line_label(camera, eye, normalize(direction)));
}

#ifdef __cplusplus
}  // namespace ods
#endif
