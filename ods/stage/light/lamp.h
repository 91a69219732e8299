// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A soft lamp for a room without lamps: a glowing disc that faces down.
#pragma once
#include <functional>
#include <optional>

#include "ods/scene/scene.h"

namespace ods {

struct CeilingLamp {
  vec3 position{0.0f};  // centre of the lamp
  float radius = 0.5f;
  float height = 2.5f;  // above the surface below
};

// The distance from a point along a unit vector to the first surface; infinite if there is none.
using Clearance = std::function<float(vec3 from, vec3 direction)>;

// Places a lamp just below the ceiling, in the middle of the space visible at that height from above `eye`. It is a
// fifth as wide as it is high above the floor, or less if there is not enough space. Returns nullopt if there is no
// ceiling or no floor. Precondition: eye is in free space.
std::optional<CeilingLamp> place_lamp(vec3 eye, const Clearance& clearance);

// A lamp at a given place, with a size that fits its height there; `height` is 2.5 m if there is no floor.
CeilingLamp lamp_at(vec3 position, const Clearance& clearance);

// Adds the lamp, so bright that a white Lambert floor below it has a radiance of 0.4 from its direct light. It is
// visible from below only. The camera sees it no brighter than kSeenLamp (ods/kernel/path_light.h), because its full
// radiance, about 100 times that of the floor, would give it a ragged rim; mirrors and glass show it in full.
void add_lamp(Scene& scene, const CeilingLamp& lamp);

}  // namespace ods
