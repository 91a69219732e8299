// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The unit of the lamps in a file. glTF has candela and lux, but says nothing of how they compare with emission;
// Blender writes watts times 683 lumens for lamps, and emission as it is.
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

// Whether the lamps are 683 times as bright as what glows beside them: Blender wrote the file, or all lamps have round
// numbers of watts, as after another program has compressed it; something in it glows, and a lamp is brighter than any
// in watts: 100 candela, or a sun of 50 lux.
bool lamps_are_in_watts(const Scene& scene);

// Multiplies the intensity of all lamps, moving ones too. Leaves the scene at rest. Precondition: no clip plays.
void scale_lamps(Scene& scene, double factor);

}  // namespace ods
