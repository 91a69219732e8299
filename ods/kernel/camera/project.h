// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// World point -> image position in each eye: the inverse of camera_ray().
//
// Let rho be the point's distance from the camera's axis and y its height above the viewing circle's plane.
// The ray that meets the point starts r to the side of the axis and n in front of it, in the heading F with R to its
// right. Parallel:
//   rho^2 = r^2 + L^2 with L = dot(point, F) = n + t cos(phi),   tan(phi) = y / (L - n).
// With toe-in at C it leaves along C d - r R, and at s times that vector
//   rho^2 = r^2 (1 - s)^2 + (n + s C cos(phi))^2,   y = s C sin(phi).
// Both have a closed form without a merge and a neck, below the start of a merge, and for r = ipd/2 cos(phi). Otherwise
// r and n depend on phi, and the equation in phi has one root, because rays do not cross if the circle shrinks towards
// the poles. Bisection finds the root.
//
// A head-tilt map moves the eyes out of the circle's plane, so none of this holds there; look_of_point() (line.h)
// iterates instead.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/camera/line.h"
namespace ods {
#endif

struct ImagePosition {
  vec2 uv;      // both 0..1
  float depth;  // along the ray from its own origin
  vec3 origin;  // the ray's origin, in the world
  bool seen;    // false if no ray of this eye meets the point, or the picture does not contain it
};

// The position of the point relative to the ray at one elevation: the point's coordinates across and along the heading,
// and the distance by which the ray passes below it (negative if above).
struct Meeting {
  float across;  // dot(point, R)
  float along;   // dot(point, F)
  float below;
  float depth;
};

// r, n: after the merge. No ray meets points closer to the axis than r; the closest ray is used instead.
inline Meeting meet(Camera camera, float r, float n, float rho, float y, float phi) {
  vec2 rise = cos_sin(phi);
  Meeting meeting;
  meeting.across = r;
  if (camera.convergence != kToeIn) {
    meeting.along = sqrt(max(rho * rho - r * r, 0.0f));
    meeting.below = y * rise.x - (meeting.along - n) * rise.y;
    meeting.depth = length(vec2(meeting.along - n, y));
    return meeting;
  }
  float c = camera.convergence_distance;
  float square = r * r + c * c;
  float middle = r * r - n * c * rise.x;
  float s = (middle + sqrt(max(middle * middle - square * (r * r + n * n - rho * rho - y * y), 0.0f))) / square;
  meeting.across = r * (1.0f - s);
  meeting.along = sqrt(max(rho * rho - meeting.across * meeting.across, 0.0f));
  meeting.below = y - s * c * rise.y;
  meeting.depth = s * sqrt(square);
  return meeting;
}

// The elevation 0..pi/2 of the ray that meets a point of height y >= 0, without merge and neck.
inline float plain_elevation(Camera camera, float r, float rho, float y) {
  Meeting meeting = meet(camera, r, 0.0f, rho, y, 0.0f);
  if (camera.convergence != kToeIn) return atan_of(y, meeting.along);
  float c = camera.convergence_distance;
  return asin_of(clamp(y * sqrt(r * r + c * c) / max(meeting.depth * c, 1e-30f), 0.0f, 1.0f));
}

inline bool shrinks_as_cosine(PoleMerge merge) {
  return merge.mode == kMergeCosine && merge.start == 0.0f && merge.exponent == 1.0f && merge.end > 0.4999f * kPi;
}

inline float cosine_elevation(float r, float rho, float y) {
  float b = r * r + rho * rho + y * y;
  float cos2 = 2.0f * rho * rho / (b + sqrt(max(b * b - 4.0f * r * r * rho * rho, 0.0f)));
  float merged = r * sqrt(min(cos2, 1.0f));
  return atan_of(y, sqrt(max(rho * rho - merged * merged, 0.0f)));
}

// phi with its sign. heading: the point's, needed for a merge map, which is a function of direction.
inline float elevation_of(Camera camera, float r, float rho, float y, vec3 heading) {
  PoleMerge merge = camera.top;
  if (y < 0.0f) merge = camera.bottom;
  float sign_of_y = y < 0.0f ? -1.0f : 1.0f;
  if (camera.neck == 0.0f) {
    float plain = plain_elevation(camera, r, rho, abs(y));
    bool merges = merge.mode != kMergeNone && (merge.mode == kMergeMap || plain > merge.start);
    if (!merges || r == 0.0f) return sign_of_y * plain;
    if (camera.convergence != kToeIn && shrinks_as_cosine(merge)) return sign_of_y * cosine_elevation(r, rho, abs(y));
  }
  float low = 0.0f;
  float high = 0.5f * kPi;
  for (int i = 0; i < 40; i++) {
    float middle = 0.5f * (low + high);
    vec2 rise = cos_sin(middle);
    vec3 direction = heading * rise.x + camera.axis * (sign_of_y * rise.y);
    float left = merge_at(camera, direction, sign_of_y * middle);
    Meeting meeting = meet(camera, r * left, camera.neck * left, rho, abs(y), middle);
    if (meeting.below > 0.0f || rho < r * left) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return sign_of_y * 0.5f * (low + high);
}

// Projects a point for cameras with a head-tilt map, whose eyes leave the circle's plane.
inline ImagePosition project_by_search(Camera camera, int eye, vec3 point) {
  PointLook look = look_of_point(camera, eye, point, 1.0f);
  vec3 direction = look.direction;
  if (camera.convergence == kShift) direction = turn_about(direction, camera.axis, -shift_angle(camera, eye));
  ImagePoint place = place_of(camera.projection, direction);
  ImagePosition position;
  position.uv = place.uv;
  position.depth = length(point - look.origin);
  position.origin =
      camera.center + look.origin.x * camera.right + look.origin.y * camera.up + look.origin.z * camera.back;
  position.seen = place.seen && look.found;
  return position;
}

inline ImagePosition project_point(Camera camera, int eye, vec3 point) {
  vec3 away = point - camera.center;
  vec3 p = vec3(dot(away, camera.right), dot(away, camera.up), dot(away, camera.back));
  if (has_head_tilt(camera) && eye_side(eye) != 0.0f) return project_by_search(camera, eye, p);
  float y = dot(p, camera.axis);
  vec3 level = p - camera.axis * y;
  float rho = length(level);
  vec3 toward = rho > 0.0f ? level * (1.0f / rho) : vec3(0.0f, 0.0f, -1.0f);
  float side = eye_side(eye);
  float r = side == 0.0f ? 0.0f : 0.5f * camera.ipd;
  // A merge map needs the ray's heading, which is nearly the point's: a few iterations find it.
  int rounds = camera.top.mode == kMergeMap || camera.bottom.mode == kMergeMap ? 5 : 1;
  vec3 heading = toward;
  vec3 direction = toward;
  float left = 1.0f;
  Meeting meeting;
  for (int i = 0; i < rounds; i++) {
    float phi = elevation_of(camera, r, rho, y, heading);
    vec2 rise = cos_sin(phi);
    left = merge_at(camera, heading * rise.x + camera.axis * rise.y, phi);
    meeting = meet(camera, r * left, camera.neck * left, rho, abs(y), abs(phi));
    // The heading F from the point's own heading: dot(point, F) = along, dot(point, R) = side * across.
    float size = max(sqrt(meeting.along * meeting.along + meeting.across * meeting.across), 1e-30f);
    heading = (toward * meeting.along - cross(toward, camera.axis) * (side * meeting.across)) * (1.0f / size);
    direction = heading * rise.x + camera.axis * rise.y;
  }
  vec3 start = (cross(heading, camera.axis) * (side * r) + heading * camera.neck) * left;
  if (camera.convergence == kShift) direction = turn_about(direction, camera.axis, -shift_angle(camera, eye));
  ImagePoint place = place_of(camera.projection, direction);
  ImagePosition position;
  position.uv = place.uv;
  position.depth = meeting.depth;
  position.origin = camera.center + start.x * camera.right + start.y * camera.up + start.z * camera.back;
  position.seen = place.seen && rho >= meeting.across && meeting.depth > 0.0f && meeting.along >= camera.neck * left;
  return position;
}

#ifdef __cplusplus
}  // namespace ods
#endif
