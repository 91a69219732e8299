// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Camera moves, which give motion to a video of a static scene.
#pragma once
#include <optional>
#include <vector>

#include "ods/camera/stereo_camera.h"

namespace ods {

struct CameraMove {
  double seconds = 10.0;  // duration of the turns and the flight
  double turns = 0.0;     // turns to the right, at constant speed; they continue after `seconds`
  // If set, the camera circles the vertical line through this point and always faces it; otherwise it turns in place.
  std::optional<vec3> pivot;
  // The points that it flies through, from its own position; it starts and ends gently, and stays at the last one.
  std::vector<vec3> fly_to;
};

bool moves(const CameraMove& move);

// The camera at a time, in seconds; `camera` is the camera without the move. The flight follows a Catmull-Rom curve
// with chord lengths as knot distances, and covers its length as the smoothstep of time.
StereoCamera moved(const StereoCamera& camera, const CameraMove& move, double time);

}  // namespace ods
