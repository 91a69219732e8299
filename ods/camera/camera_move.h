// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Moves of the camera, so that a scene that stands still can make a video.
#pragma once
#include <optional>
#include <vector>

#include "ods/camera/stereo_camera.h"

namespace ods {

struct CameraMove {
  double seconds = 10.0;      // what the turns and the flight take
  double turns = 0.0;         // to the right, at constant speed, and on after the time
  std::optional<vec3> pivot;  // the camera goes around the vertical line through it and keeps its face to it; none: it
                              // turns where it stands
  std::vector<vec3> fly_to;   // the places that it flies through, from where it stands; it starts and ends gently,
                              // and stays at the last one
};

bool moves(const CameraMove& move);

// The camera at a time, moved from where it is without the move. The flight follows a Catmull-Rom curve,
// chords as knot distances, and covers its length by the smoothstep of time.
StereoCamera moved(const StereoCamera& camera, const CameraMove& move, double time);

}  // namespace ods
