// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Eye and image position -> ray: the omni-directional stereo camera, a pure function.
// Source: Google, "Rendering Omni-directional Stereo Content", Ray tracing the ODS projection. StereoCamera's defaults
// give exactly that model; the other parameters are those of other systems:
//
//   a ray of heading F, with R to its right, starts at   E + merge * neck * F   with E = merge * side * ipd/2 * R
//   and has the projection's direction d, or, with toe-in at a distance C, the direction   C * d - E.
//
// A head-tilt map turns E about d, clockwise as the viewer sees it, by (map - 1/2) pi: at 1 the head lies on its right
// side and the right eye is below the left one. The neck's part of the origin stays. Source: Domemaster3D,
// LatLongStereo (mental ray). kShift rotates the pictures about the circle's axis, independently of the tilt.
//
// Image positions may be outside 0..1 (ods/kernel/camera/projection.h): lat-long wraps, and continues over the pole,
// where the formula itself continues into the other eye's picture half a turn away, as a wide pixel filter needs.
#ifdef __cplusplus
#pragma once
#include <cstddef>

#include "ods/kernel/camera/projection.h"
namespace ods {
#endif

const int kLeft = 0;
const int kRight = 1;
const int kMono = 2;

const int kParallel = 0;
const int kToeIn = 1;  // the rays of both eyes in one direction meet at the distance
const int kShift = 2;  // the eyes' pictures are rotated against each other: no parallax at the distance
const int kConvergenceCount = 3;

#ifdef __cplusplus
struct TexelRay;
#endif

// The size of a lat-long picture of values 0..1 in the camera's frame, rows from the top.
struct CameraMap {
  int width;  // 0 if there is no map
  int height;
};

const int kMapOfMerge = 0;
const int kMapOfHeadTilt = 1;

struct Camera {
  vec3 center;  // centre of the viewing circle
  vec3 right;   // an orthonormal frame, right-handed unless the picture is mirrored
  vec3 up;
  vec3 back;
  vec3 axis;  // normal of the viewing circle in that frame, unit length; (0, 1, 0) is up
  float ipd;
  float neck;  // distance of the eyes in front of the centre, metres
  int convergence;
  float convergence_distance;
  float lens_radius;     // 0 if everything is sharp
  float focus_distance;  // along the ray from the eye
  PoleMerge top;
  PoleMerge bottom;
  Projection projection;
  CameraMap merge_map;      // for kMergeMap
  CameraMap head_tilt_map;  // 0.5 is level
  CameraMap texel_rays;     // the size of a table of rays, one for each pixel (ods/kernel/camera/texel_ray.h)
#ifdef __cplusplus
  // The values of the maps and the table, beside the camera: a shader has them in a buffer or a texture. All fields
  // above have the same bytes in a shader, kCameraBytes in total.
  const float* merge_texels = nullptr;
  const float* head_tilt_texels = nullptr;
  const TexelRay* texel_table = nullptr;
#endif
};

struct Ray {
  vec3 origin;
  vec3 direction;  // unit length; 0 if the picture is empty here
};

#ifdef __cplusplus
inline constexpr size_t kCameraBytes = offsetof(Camera, texel_rays) + sizeof(CameraMap);

inline float camera_map_texel(const Camera& camera, int which, int i) {
  return (which == kMapOfMerge ? camera.merge_texels : camera.head_tilt_texels)[i];
}
#else
float camera_map_texel(Camera camera, int which, int i);
#endif

inline float camera_map_at(Camera camera, int which, vec3 direction) {
  CameraMap map = camera.merge_map;
  if (which == kMapOfHeadTilt) map = camera.head_tilt_map;
  vec2 uv = direction_to_lat_long(direction);
  float x = uv.x * float(map.width) - 0.5f;
  float y = uv.y * float(map.height) - 0.5f;
  int x0 = int(floor(x));
  int y0 = int(floor(y));
  int left = x0 < 0 ? map.width - 1 : x0;
  int right = x0 + 1 >= map.width ? 0 : x0 + 1;
  int top = clamp(y0, 0, map.height - 1) * map.width;
  int bottom = clamp(y0 + 1, 0, map.height - 1) * map.width;
  float fx = x - float(x0);
  return mix(mix(camera_map_texel(camera, which, top + left), camera_map_texel(camera, which, top + right), fx),
             mix(camera_map_texel(camera, which, bottom + left), camera_map_texel(camera, which, bottom + right), fx),
             y - float(y0));
}

// The fraction of the viewing circle's radius that remains after the merge, for a direction (camera's frame) with the
// elevation phi above the circle's plane. Beyond a pole the elevation decreases again.
inline float merge_at(Camera camera, vec3 direction, float phi) {
  PoleMerge merge = camera.top;
  if (phi < 0.0f) merge = camera.bottom;
  if (merge.mode == kMergeMap) return camera_map_at(camera, kMapOfMerge, direction);
  float elevation = abs(phi);
  if (elevation > 0.5f * kPi) elevation = abs(kPi - elevation);
  return merge_factor(merge, elevation);
}

inline float eye_side(int eye) {
  return eye == kLeft ? -1.0f : eye == kRight ? 1.0f : 0.0f;
}

inline vec3 turn_about(vec3 v, vec3 axis, float angle) {
  vec2 turn = cos_sin(angle);
  return v * turn.x + cross(axis, v) * turn.y + axis * (dot(axis, v) * (1.0f - turn.x));
}

// The angle by which kShift rotates an eye's picture to the right.
inline float shift_angle(Camera camera, int eye) {
  return eye_side(eye) * asin_of(clamp(0.5f * camera.ipd / camera.convergence_distance, 0.0f, 1.0f));
}

// Recomputes heading and elevation relative to the camera's axis instead of its up vector.
inline ViewDirection look_about_axis(Camera camera, ViewDirection look) {
  if (camera.axis.y == 1.0f) return look;
  float height = clamp(dot(look.direction, camera.axis), -1.0f, 1.0f);
  vec3 level = look.direction - camera.axis * height;
  float size = length(level);
  look.elevation = atan_of(height, size);
  if (size > 1e-20f) look.heading = level * (1.0f / size);
  return look;
}

inline bool has_head_tilt(Camera camera) {
  return camera.head_tilt_map.width > 0;
}

// The eye's position for a ray that looks along `look`, relative to the circle's centre, in the camera's frame. It is
// the sum of the two.
struct EyeOffset {
  vec3 stereo;
  vec3 neck;
};

inline EyeOffset eye_offset(Camera camera, int eye, ViewDirection look) {
  float left = merge_at(camera, look.direction, look.elevation);
  EyeOffset offset;
  offset.stereo = cross(look.heading, camera.axis) * (0.5f * camera.ipd * eye_side(eye) * left);
  offset.neck = look.heading * (camera.neck * left);
  if (has_head_tilt(camera)) {
    float tilt = (camera_map_at(camera, kMapOfHeadTilt, look.direction) - 0.5f) * kPi;
    offset.stereo = turn_about(offset.stereo, look.direction, tilt);
  }
  return offset;
}

// home: the centre of the pixel to which the position uv belongs. lens: uniform in the unit square, chooses the ray's
// point on the lens; x = 0 is the lens's centre.
inline Ray camera_ray(Camera camera, int eye, vec2 home, vec2 uv, vec2 lens) {
  ViewDirection look = look_of(camera.projection, home, uv);
  Ray ray;
  ray.origin = camera.center;
  ray.direction = vec3(0.0f);
  if (!look.seen) return ray;
  look = look_about_axis(camera, look);
  if (camera.convergence == kShift) {
    float angle = shift_angle(camera, eye);  // the ray turns left when the picture turns right
    look.direction = turn_about(look.direction, camera.axis, angle);
    look.heading = turn_about(look.heading, camera.axis, angle);
  }
  EyeOffset offset = eye_offset(camera, eye, look);
  vec3 origin = offset.stereo + offset.neck;
  vec3 direction = look.direction;
  if (camera.convergence == kToeIn) direction = normalize(direction * camera.convergence_distance - offset.stereo);
  if (camera.lens_radius > 0.0f) {
    // A disc about the eye, perpendicular to the ray; all its rays meet at the focus distance.
    vec3 side = normalize(cross(direction, abs(direction.y) < 0.9f ? vec3(0.0f, 1.0f, 0.0f) : vec3(1.0f, 0.0f, 0.0f)));
    float r = camera.lens_radius * sqrt(lens.x);
    vec2 around = cos_sin(2.0f * kPi * lens.y);
    vec3 on_lens = side * (r * around.x) + cross(side, direction) * (r * around.y);
    direction = normalize(direction * camera.focus_distance - on_lens);
    origin = origin + on_lens;
  }
  ray.origin = camera.center + origin.x * camera.right + origin.y * camera.up + origin.z * camera.back;
  ray.direction = direction.x * camera.right + direction.y * camera.up + direction.z * camera.back;
  return ray;
}

#ifdef __cplusplus
// The ray through the centre of the lens, as if uv were the centre of a pixel.
inline Ray camera_ray(const Camera& camera, int eye, vec2 uv) {
  return camera_ray(camera, eye, uv, uv, vec2(0.0f, 0.0f));
}
}  // namespace ods
#endif
