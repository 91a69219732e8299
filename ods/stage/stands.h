// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Searches a scene for places where somebody can be. Other rooms call survey().
#pragma once
#include <optional>

#include "ods/stage/survey.h"

namespace ods {

// The best of the places where a person stands on a floor, in free space, with the scene around. None in an object, on
// whose top one could stand but would see nothing.
std::optional<Stand> best_stand(const SceneRays& rays, const Bounds& core, float metres_per_unit);

// The best place in free space among things that float on nearly all sides. None if there is none.
std::optional<Stand> best_float(const SceneRays& rays, const Bounds& core, float metres_per_unit);

}  // namespace ods
