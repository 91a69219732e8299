// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Worlds by formula, seen through any camera: exact in every projection, with detail and parallax everywhere, and no
// two similar sides.
#pragma once
#include <array>
#include <string>

#include "ods/base/extent.h"
#include "ods/camera/stereo_camera.h"
#include "ods/image/image.h"

namespace ods {

enum class World { kHall, kField, kCave, kTiles };
inline constexpr std::array kWorlds = {World::kHall, World::kField, World::kCave};  // like pictures
inline std::string world_name(World world) {
  constexpr std::array kNames = {"hall", "field", "cave", "tiles"};
  return kNames[static_cast<size_t>(world)];
}

// Smooth noise of the octaves from `size` metres down, 0..1.
float noise_at(vec3 p, float size, uint32_t seed);

vec3 world_at(World world, vec3 origin, vec3 direction);

// Linear, 3 channels; black outside the projection. is_pair: two fixed cameras instead of a circle.
Image seen_in(World world, const StereoCamera& stereo, int eye, Extent size, bool is_pair = false);

}  // namespace ods
