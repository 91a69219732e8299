// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A scene while the shutter is open.
#pragma once
#include "ods/scene/motion.h"

namespace ods {

// Between two keys everything goes straight: of a turn by 60 degrees within the shutter the radius is short by 0.9 % in
// the middle between two of these.
inline constexpr int kShutterKeys = 5;

// set_time() at the middle of the times, and what moves between them into the scene's motion rows, at kShutterKeys
// times. Vertices and matrices move within the shutter; lights, materials and view points are those of the middle. What
// is hidden at one of the keys is hidden. Precondition: opens <= closes.
SceneChange open_shutter(Scene& scene, double opens, double closes);

}  // namespace ods
