// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Rotates an object in place; viewer, light and ground do not move.
#pragma once
#include "ods/scene/scene.h"

namespace ods {

// Maximum number of turns, over all frames.
inline constexpr double kMaxTurns = 100000.0;

// Adds a clip to the scene's animation, and plays it. It turns all visible instances of the scene itself about the
// vertical line through `middle`: clockwise as seen from above, `turns` in `seconds`, at constant speed from time 0
// until `end` at least. Objects moved by the scene's own clips keep moving on the turning table; lights, view points
// and shadow catchers do not turn. Precondition: seconds > 0, turns / seconds * end <= kMaxTurns.
void turn_object(Scene& scene, vec3 middle, double turns, double seconds, double end);

}  // namespace ods
