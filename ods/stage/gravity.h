// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Signs of the direction of gravity in a scene: names, cameras, things that stand in a room.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

// The box of each instance in the world, at rest; nullopt for hidden instances and for meshes without vertices.
std::vector<std::optional<Bounds>> instance_boxes(const Scene& scene);

// Returns the sign by which +Z is up in a scene whose file claims that +Y is, as part of a message; empty if there is
// none, or one for +Y. At rest. The signs are:
// - things named floor, ground or ceiling, in English, German, French or Spanish, which are level and at the bottom, or
//   at the top, of the scene;
// - cameras that look to a side and have +Z above them;
// - a room with a floor and three walls, in which six things or more stand on the floor or above it, four of them not
//   flat on the floor, and at most half as many at each wall. Pictures on a wall are flat.
std::string sign_of_z_up(const Scene& scene);

}  // namespace ods
