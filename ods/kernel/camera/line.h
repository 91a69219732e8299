// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Line of sight -> position in a picture, for everything that shows or converts one: a display knows the direction in
// which a viewer looks, not the point that is seen.
//
// A line of sight is identified by its direction alone: pictures with the same viewing circle and merge contain the
// same lines, and differ only in where they put them.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/camera/look_of_point.h"
namespace ods {
#endif

// The direction d' under which a toed-in picture stores the line of direction d: C d' minus the eye's offset is
// parallel to d. The offset's size depends on the elevation, through the merge: a few iterations find both.
inline vec3 toed_in_label(Camera camera, int eye, vec3 d) {
  if (has_head_tilt(camera)) return look_of_point(camera, eye, d, 0.0f).direction;
  float c = camera.convergence_distance;
  float height = dot(d, camera.axis);
  vec3 level = d - camera.axis * height;
  if (length(level) == 0.0f) return d;
  float phi = asin(clamp(height, -1.0f, 1.0f));
  float r = 0.0f;
  for (int i = 0; i < 8; i++) {
    r = 0.5f * camera.ipd * abs(eye_side(eye)) * merge_at(camera, d, phi);
    phi = asin(clamp(height * sqrt(1.0f + r * r / (c * c)), -1.0f, 1.0f));
  }
  float turn = -eye_side(eye) * atan(r, c * cos(phi));
  return turn_about(normalize(level), camera.axis, turn) * cos(phi) + camera.axis * sin(phi);
}

// The direction of the projection, in the camera's frame, where an eye's picture has the line of sight of a direction
// in that frame (unit length).
inline vec3 line_label(Camera camera, int eye, vec3 direction) {
  if (camera.convergence == kToeIn) return toed_in_label(camera, eye, direction);
  if (camera.convergence == kShift) return turn_about(direction, camera.axis, -shift_angle(camera, eye));
  return direction;
}

// Where an eye's picture has the line of sight of a direction in the camera's frame, any length but 0.
inline ImagePoint place_of_line(Camera camera, int eye, vec3 direction) {
  return place_of(camera.projection, line_label(camera, eye, normalize(direction)));
}

#ifdef __cplusplus
}  // namespace ods
#endif
