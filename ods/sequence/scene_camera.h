// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A camera in a scene. The caller sets eyes and lens, and the place if it differs from the scene's.
#pragma once
#include <optional>
#include <string>

#include "ods/camera/camera_move.h"
#include "ods/scene/scene.h"

namespace ods {

struct SceneCamera {
  StereoCamera stereo;               // all but its position and its angles
  std::string view_point;            // a camera of the file, by name; "none" or empty: default_view()
  std::optional<vec3> position;      // nullopt: the place of the view point
  std::optional<float> yaw;          // degrees; nullopt: the yaw of the view point
  std::optional<float> pitch, roll;  // degrees; nullopt: 0, as the horizon must be level in a headset
  CameraMove move;
};

// Returns the view point that the camera starts from, in the scene as it is now. Throws Error(kUsage) if no view point
// has that name.
ViewPoint view_of(const SceneCamera& camera, const Scene& scene);

// Returns the camera in the scene as it is now, without its move. Throws Error(kUsage) as view_of() does, and if a
// number of the view point is out of the camera's range.
StereoCamera camera_in(const SceneCamera& camera, const Scene& scene);

// Returns the camera at a time, in seconds. Precondition: the scene is set to that time. Throws as camera_in() does.
StereoCamera camera_at(const SceneCamera& camera, const Scene& scene, double seconds);

// Returns whether the file's animation, as it plays, moves the camera. Throws as view_of() does.
bool is_moved_by_file(const SceneCamera& camera, const Scene& scene);

}  // namespace ods
