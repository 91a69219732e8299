// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Real-time objects in a layered scene, and the file beside it that keeps their places: room.objects.json beside
// room.layers.glb. docs/view.md describes it.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "ods/kernel/math.h"

namespace ods {

inline constexpr size_t kMaxPlacements = 64;       // objects in a scene
inline constexpr float kFarthestPlacement = 1e6f;  // metres from the origin along an axis

struct Placement {
  std::string file;   // of the object: a path, or the name of a built-in scene
  vec3 at{0.0f};      // where its own origin is put, metres, in the scene
  float turn = 0.0f;  // degrees about +Y, counter-clockwise as seen from above
};

// The name of the file that keeps the objects of a layered scene.
std::string placements_path(const std::string& layered);

// Empty if there is no such file. Paths in the file are relative to its folder. Throws Error(kInput) if it is damaged.
std::vector<Placement> read_placements(const std::string& layered);

// Returns the file's path. Throws Error(kOutput).
std::string write_placements(const std::string& layered, std::span<const Placement> placements);

// Reads the list that a page sends: {"objects": [{"name": ..., "at": [x, y, z], "turn": D}, ...]}, and moves the
// placements, which have the same order. Throws Error(kInput), and changes nothing, if it is invalid or has another
// length.
void move_placements(const std::string& message, std::vector<Placement>& placements);

}  // namespace ods
