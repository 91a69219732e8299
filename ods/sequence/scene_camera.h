// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A camera in a scene: its eyes and its lens are chosen, its place is the scene's unless it is chosen, too.
#pragma once
#include <optional>
#include <string>

#include "ods/camera/camera_move.h"
#include "ods/scene/scene.h"

namespace ods {

struct SceneCamera {
  StereoCamera stereo;               // all but its position and its angles
  std::string view_point;            // a camera of the file, by name; "none" or empty: default_view()
  std::optional<vec3> position;      // nullopt: that of the view point
  std::optional<float> yaw;          // degrees; nullopt: that of the view point
  std::optional<float> pitch, roll;  // degrees; nullopt: 0, as the horizon must be level in a headset
  CameraMove move;
};

// The view point that the camera starts from, in the scene as it is now. Throws Error(kUsage): no view point has that
// name.
ViewPoint view_of(const SceneCamera& camera, const Scene& scene);

// The camera in the scene as it is now, without its move. Throws Error(kUsage): as view_of(), and where a number of the
// view point is out of the camera's range.
StereoCamera camera_in(const SceneCamera& camera, const Scene& scene);

// The camera at a time, in seconds. Precondition: the scene is as it is then. Throws as camera_in().
StereoCamera camera_at(const SceneCamera& camera, const Scene& scene, double seconds);

// Whether the file's animation, as it plays, moves the camera. Throws as view_of().
bool is_moved_by_file(const SceneCamera& camera, const Scene& scene);

}  // namespace ods
