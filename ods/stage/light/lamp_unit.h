// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The unit of the lamps in a file. glTF defines candela and lux, but not how they relate to emission; Blender writes
// watts times 683 lumens for lamps, and emission unchanged.
#pragma once
#include "ods/base/names.h"
#include "ods/scene/scene.h"

namespace ods {

enum class LampUnit { kAuto, kCandela, kWatt };
inline constexpr NameRow<LampUnit> kLampUnitTable[] = {
    {LampUnit::kAuto, "auto"},
    {LampUnit::kCandela, "candela"},
    {LampUnit::kWatt, "watt"},
};
static_assert(has_every_member(kLampUnitTable));

inline constexpr double kLumensPerWatt = 683.0;

// Returns whether the lamps are 683 times too bright relative to emissive surfaces: Blender wrote the file, or all
// lamps have round numbers of watts, as after another program has compressed it; the scene has emissive surfaces, and a
// lamp is brighter than any in watts: 100 candela, or a sun of 50 lux.
bool lamps_are_in_watts(const Scene& scene);

// Multiplies the intensity of all lamps, including moving ones. Leaves the scene at rest. Precondition: no clip plays.
void scale_lamps(Scene& scene, double factor);

}  // namespace ods
