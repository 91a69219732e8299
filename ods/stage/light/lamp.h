// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A soft lamp for a room that has none: a glowing disc that faces down.
#pragma once
#include <functional>
#include <optional>

#include "ods/scene/scene.h"

namespace ods {

struct CeilingLamp {
  vec3 position{0.0f};  // of its centre
  float radius = 0.5f;
  float height = 2.5f;  // above what is beneath it
};

// The distance from a point along a unit vector to the first surface; infinite if there is none.
using Clearance = std::function<float(vec3 from, vec3 direction)>;

// A lamp just below the ceiling, in the middle of what is visible at that height from above `eye`, a fifth as wide as
// it is high above the floor, or less where there is less room. None if there is no ceiling or no floor.
// Precondition: eye is in free space.
std::optional<CeilingLamp> place_lamp(vec3 eye, const Clearance& clearance);

// A lamp at a given place, as large as suits its height there; `height` is 2.5 m if there is no floor.
CeilingLamp lamp_at(vec3 position, const Clearance& clearance);

// Adds the lamp, so bright that a white Lambert floor beneath it has a radiance of 0.4 by its direct light. It is
// visible from below only. The camera sees it no brighter than kSeenLamp (ods/kernel/path_light.h), as its full
// radiance, some 100 times that of the floor, would leave it a ragged rim; mirrors and glass show it in full.
void add_lamp(Scene& scene, const CeilingLamp& lamp);

}  // namespace ods
