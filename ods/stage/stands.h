// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Searches a scene for positions of a viewer. Other modules call survey().
#pragma once
#include <optional>

#include "ods/stage/survey.h"

namespace ods {

// The best of the places where a person can stand on a floor, in free space, with the scene around. Returns nullopt for
// an object, on top of which a person could stand but would see nothing.
std::optional<Stand> best_stand(const SceneRays& rays, const Bounds& core, float metres_per_unit);

// The best place in free space among objects that float on nearly all sides. Returns nullopt if there is none.
std::optional<Stand> best_float(const SceneRays& rays, const Bounds& core, float metres_per_unit);

}  // namespace ods
