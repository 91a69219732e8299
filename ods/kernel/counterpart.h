// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the place in the other eye's picture that shows the same point of the scene as a sample of this eye's picture,
// so that one path can serve both.
//
// A sample is a pixel and an offset from its centre. Its counterpart is the pixel of the other eye for which the same
// point of the scene has nearly the same offset: less than half a pixel apart. (With a box filter, which ends at the
// pixel's edge, it is the pixel that contains the point.) So samples and counterparts form pairs, each is the other's
// counterpart, and no two samples of a pixel compete.
//
// `density` turns probabilities of this eye into those of the other: the filter there over the filter here, times the
// image area of a piece of the scene here over its image area there. A point has the same elevation, distance and
// circle in both eyes, since they are mirror images of each other. So that ratio is the solid angle of the picture here
// over the solid angle there, times cos(there) / cos(here) of the angles at the surface, which path.h adds.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/camera/project.h"
#include "ods/kernel/filter.h"
namespace ods {
#endif

struct Counterpart {
  bool exists;
  int x;  // the pixel
  int y;
  vec3 origin;  // origin of the other eye's ray to the point
  vec3 direction;
  float distance;
  float density;  // without the cosines
};

// Returns whether project_point() is a closed form for the points on rays of this direction (unit length).
inline bool projects_quickly(Camera camera, vec3 direction) {
  if (camera.neck != 0.0f || has_head_tilt(camera)) return false;
  vec3 axis = camera.axis.x * camera.right + camera.axis.y * camera.up + camera.axis.z * camera.back;
  float height = dot(direction, axis);
  PoleMerge merge = camera.top;
  if (height < 0.0f) merge = camera.bottom;
  if (merge.mode == kMergeNone) return true;
  if (merge.mode == kMergeMap || camera.convergence == kToeIn) return false;
  return shrinks_as_cosine(merge) || asin_of(min(abs(height), 1.0f)) <= merge.start;
}

inline bool wraps_around(Projection projection) {
  return has_range(projection.kind) && projection.span.x > 2.0f * kPi - 1e-4f;
}

// point: the scene point that the sample at uv of pixel (x, y) shows, by a ray of this direction. size: the picture's,
// pixels.
inline Counterpart counterpart_of(Camera camera, int filter_shape, vec2 size, int eye, vec2 pixel, vec2 uv,
                                  vec3 direction, vec3 point) {
  Counterpart found;
  found.exists = false;
  bool wraps = wraps_around(camera.projection);
  vec2 home = (pixel + vec2(0.5f)) / size;
  vec2 offset = (uv - home) * size;
  if (wraps) uv.x = uv.x - floor(uv.x);
  if (!inside_picture(uv) || !same_face(camera.projection, home, uv)) return found;
  if (!projects_quickly(camera, direction)) return found;
  ImagePosition place = project_point(camera, eye == kLeft ? kRight : kLeft, point);
  if (!place.seen) return found;
  vec2 at = place.uv * size - vec2(0.5f);
  vec2 wanted = at;
  if (filter_shape != kFilterBox) wanted = at - offset;
  vec2 other = vec2(floor(wanted.x + 0.5f), floor(wanted.y + 0.5f));
  vec2 other_offset = at - other;
  if (wraps) other.x = other.x - size.x * floor(other.x / size.x);
  vec2 other_home = (other + vec2(0.5f)) / size;
  if (!inside_picture(other_home) || !same_face(camera.projection, other_home, place.uv)) return found;
  if (has_image_circle(camera.projection.kind) && !inside_circle(camera.projection, other_home)) return found;
  float here = filter_value(filter_shape, offset.x) * filter_value(filter_shape, offset.y);
  float there = filter_value(filter_shape, other_offset.x) * filter_value(filter_shape, other_offset.y);
  float angle_there = relative_solid_angle(camera.projection, other_home, place.uv);
  if (!(here > 0.0f && there > 0.0f && angle_there > 0.0f)) return found;
  found.exists = true;
  found.x = int(other.x);
  found.y = int(other.y);
  found.origin = place.origin;
  vec3 away = point - place.origin;
  found.distance = length(away);
  found.direction = away * (1.0f / max(found.distance, 1e-20f));
  found.density = there * relative_solid_angle(camera.projection, home, uv) / (here * angle_there);
  return found;
}

#ifdef __cplusplus
}  // namespace ods
#endif
