// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Turns an object on the spot while viewer, light and ground stay.
#pragma once
#include "ods/scene/scene.h"

namespace ods {

// The most turns, of all frames together.
inline constexpr double kMostTurns = 100000.0;

// Adds a clip to the scene's animation, and plays it, that turns all visible instances of its own about the vertical
// line through `middle`: clockwise as seen from above, `turns` in `seconds`, at constant speed from time 0 until `end`
// at least. What the scene's own clips move goes on moving on the turning table; lights, view points and shadow
// catchers stay. Precondition: seconds > 0, turns / seconds * end <= kMostTurns.
void turn_object(Scene& scene, vec3 middle, double turns, double seconds, double end);

}  // namespace ods
