// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/sequence/scene_camera.h"

#include <fmt/format.h>

#include <algorithm>

#include "ods/base/error.h"
#include "ods/base/suggest.h"
#include "ods/camera/camera_fields.h"
#include "ods/scene/motion.h"
#include "ods/stage/place.h"

namespace ods {
namespace {

bool is_named(const SceneCamera& camera) {
  return camera_choice(camera.view_point) == CameraChoice::kNamed;
}

// The index of the view point of that name.
size_t find_view_point(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.view_points, name, &ViewPoint::name);
  if (found != scene.view_points.end()) return static_cast<size_t>(found - scene.view_points.begin());
  if (scene.view_points.empty()) {
    throw Error(ErrorKind::kUsage, "`camera`: the scene has no camera; use `position` X,Y,Z");
  }
  std::vector<std::string> names;
  for (const ViewPoint& view : scene.view_points) names.push_back(view.name);
  throw Error(ErrorKind::kUsage, fmt::format("`camera`: the scene has no camera '{}'{} (ods info lists them)", name,
                                             did_you_mean(name, names)));
}

}  // namespace

ViewPoint view_of(const SceneCamera& camera, const Scene& scene) {
  return is_named(camera) ? scene.view_points[find_view_point(scene, camera.view_point)] : default_view(scene);
}

StereoCamera camera_in(const SceneCamera& camera, const Scene& scene) {
  const ViewPoint view = view_of(camera, scene);
  StereoCamera stereo = camera.stereo;
  stereo.position = camera.position.value_or(view.position);
  stereo.yaw = camera.yaw.value_or(view.yaw);
  stereo.pitch = camera.pitch.value_or(0.0f);
  stereo.roll = camera.roll.value_or(0.0f);
  const std::string fault = camera_fault(stereo);
  if (!fault.empty()) throw Error(ErrorKind::kUsage, "the camera's " + fault);
  return stereo;
}

StereoCamera camera_at(const SceneCamera& camera, const Scene& scene, double seconds) {
  return moved(camera_in(camera, scene), camera.move, seconds);
}

bool is_moved_by_file(const SceneCamera& camera, const Scene& scene) {
  if (camera.position && camera.yaw) return false;
  if (!is_named(camera)) return uses_own_camera(scene) && moves_view(scene.animation, 0);
  return moves_view(scene.animation, static_cast<int>(find_view_point(scene, camera.view_point)));
}

}  // namespace ods
