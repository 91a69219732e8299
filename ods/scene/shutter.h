// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The motion of a scene while the shutter is open.
#pragma once
#include "ods/scene/motion.h"

namespace ods {

// Motion between keys is linear: for a rotation by 60 degrees during the shutter, the radius is 0.9 % too short half
// way between two keys.
inline constexpr int kShutterKeys = 5;

// Calls set_time() for the middle of the interval, and stores the motion during it in the scene's motion rows, at
// kShutterKeys times. Vertices and matrices move during the shutter; lights, materials and view points keep their state
// at the middle. An instance hidden at one of the keys is hidden. Precondition: opens <= closes.
SceneChange open_shutter(Scene& scene, double opens, double closes);

}  // namespace ods
