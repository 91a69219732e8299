// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/stereo_camera.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "ods/camera/camera_fields.h"
#include "ods/kernel/camera/texel_ray.h"

namespace ods {

bool same_merge(const PoleMergeSetting& a, const PoleMergeSetting& b) {
  const bool none = a.mode == kMergeNone && b.mode == kMergeNone;
  return none || (a.mode == b.mode && a.start == b.start && a.end == b.end && a.exponent == b.exponent);
}

bool same_map(const std::shared_ptr<const Image>& a, const std::shared_ptr<const Image>& b) {
  return a == b || (a && b && a->width == b->width && a->height == b->height && a->pixels == b->pixels);
}

static bool is_same_around(const CameraMap& map, const float* texels) {
  for (int i = 0; i < map.width * map.height; i++) {
    if (texels[i] != texels[i / map.width * map.width]) return false;
  }
  return true;
}

bool is_same_around(const Image& map) {
  return is_same_around({map.width, map.height}, map.pixels.data());
}

bool merges_same_around(const Camera& camera) {
  return is_same_around(camera.merge_map, camera.merge_texels);
}

bool same_eyes(const StereoCamera& a, const StereoCamera& b) {
  if (a.ipd != b.ipd || a.neck != b.neck || !same_merge(a.top, b.top) || !same_merge(a.bottom, b.bottom)) return false;
  const bool merges_by_map = a.top.mode == kMergeMap || a.bottom.mode == kMergeMap;
  if (merges_by_map && !same_map(a.merge_map, b.merge_map)) return false;
  if (!same_map(a.head_tilt_map, b.head_tilt_map)) return false;
  const Camera first = make_camera(a), second = make_camera(b);
  const bool same_up = length(first.up - second.up) < 1e-4f, same_right = length(first.right - second.right) < 1e-4f;
  for (const std::shared_ptr<const Image>& map : {merges_by_map ? a.merge_map : nullptr, a.head_tilt_map}) {
    if (map && !(same_up && (same_right || is_same_around(*map)))) return false;
  }
  return true;
}

static PoleMerge make_merge(const PoleMergeSetting& setting) {
  assert(setting.mode == kMergeNone || (setting.start < setting.end && setting.exponent > 0.0f));
  PoleMerge merge;
  merge.mode = setting.mode;
  merge.start = glm::radians(setting.start);
  merge.end = glm::radians(setting.end);
  merge.exponent = setting.exponent;
  return merge;
}

Camera make_camera(const StereoCamera& stereo) {
  assert(stereo.ipd >= 0.0f);
  assert(stereo.merge_map || (stereo.top.mode != kMergeMap && stereo.bottom.mode != kMergeMap));
  const auto radians = [](float degrees) { return glm::radians(static_cast<double>(degrees)); };
  const auto [right, up, back] = orientation(radians(stereo.yaw), radians(stereo.pitch), radians(stereo.roll));
  Camera camera;
  camera.center = stereo.position;
  camera.right = vec3(right);
  camera.up = vec3(up);
  camera.back = stereo.mirrored ? -vec3(back) : vec3(back);
  camera.axis = vec3(0.0f, 1.0f, 0.0f);
  if (stereo.axis) {
    const vec3 axis = normalize(*stereo.axis);
    camera.axis = vec3(dot(axis, camera.right), dot(axis, camera.up), dot(axis, camera.back));
  }
  camera.ipd = stereo.ipd;
  camera.neck = stereo.neck;
  camera.convergence = stereo.convergence;
  camera.convergence_distance = stereo.convergence_distance;
  camera.lens_radius = stereo.lens_radius;
  camera.focus_distance = stereo.focus_distance;
  camera.top = make_merge(stereo.top);
  camera.bottom = make_merge(stereo.bottom);
  camera.projection = make_projection(stereo.projection);
  const auto use = [](const std::shared_ptr<const Image>& image, CameraMap& map, const float*& texels) {
    map = image ? CameraMap{image->width, image->height} : CameraMap{0, 0};
    texels = image ? image->pixels.data() : nullptr;
  };
  use(stereo.merge_map, camera.merge_map, camera.merge_texels);
  use(stereo.head_tilt_map, camera.head_tilt_map, camera.head_tilt_texels);
  const TexelRays* table = stereo.texel_rays.get();
  camera.texel_rays = table ? CameraMap{table->width, table->height} : CameraMap{0, 0};
  camera.texel_table = table ? table->rays.data() : nullptr;
  return camera;
}

StereoCamera texel_camera(std::shared_ptr<const TexelRays> rays, vec3 viewer) {
  assert(rays && rays->width > 0 && rays->height > 0);
  assert(rays->rays.size() == static_cast<size_t>(rays->width) * static_cast<size_t>(rays->height));
  assert(rays->owners.size() == rays->rays.size());
  StereoCamera camera;
  camera.position = viewer;
  camera.ipd = 0.0f;
  camera.projection.kind = kPerspective;  // for the denoiser: a flat picture ends at its edges
  camera.projection.fov = 90.0f;
  camera.projection.aspect = static_cast<float>(rays->width) / static_cast<float>(rays->height);
  camera.texel_rays = std::move(rays);
  return camera;
}

void turn(StereoCamera& camera, float yaw, float pitch, float roll) {
  if (camera.pitch == 0.0f && camera.roll == 0.0f) {
    camera.yaw = angle_in_range(double{camera.yaw} + double{yaw}), camera.pitch = pitch, camera.roll = roll;
    return;
  }
  const auto frame = [](float y, float p, float r) {
    return orientation(glm::radians(double{y}), glm::radians(double{p}), glm::radians(double{r}));
  };
  const std::array<glm::dvec3, 3> own = frame(camera.yaw, camera.pitch, camera.roll), by = frame(yaw, pitch, roll);
  const auto placed = [&](glm::dvec3 v) { return v.x * own[0] + v.y * own[1] + v.z * own[2]; };
  const ViewAngles angles = view_angles(-placed(by[2]), placed(by[1]));
  camera.yaw = angles.yaw, camera.pitch = angles.pitch, camera.roll = angles.roll;
}

vec3 axis_in_world(const Camera& camera) {
  return camera.axis.x * camera.right + camera.axis.y * camera.up + camera.axis.z * camera.back;
}

ViewAngles view_angles(glm::dvec3 forward, glm::dvec3 up) {
  const double pitch = std::asin(std::clamp(forward.y, -1.0, 1.0));
  const glm::dvec3 right = glm::cross(forward, up);
  double yaw = std::atan2(forward.x, -forward.z), roll = 0.0;
  if (std::hypot(forward.x, forward.z) < 1e-6) {
    yaw = std::atan2(right.z, right.x);
  } else {
    const glm::dvec3 level_right(std::cos(yaw), 0.0, std::sin(yaw));
    roll = std::atan2(glm::dot(up, level_right), glm::dot(right, level_right));
  }
  return {static_cast<float>(glm::degrees(yaw)), static_cast<float>(glm::degrees(pitch)),
          static_cast<float>(glm::degrees(roll))};
}

}  // namespace ods
