// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A file of ods layers as the viewer opens it. The page reads the rest of it.
#pragma once
#include <string>

#include "ods/kernel/math.h"

namespace ods {

// Returns whether a .glb is a layered scene, also one that read_layers_info() refuses, such as one of a newer version.
bool is_layered_scene(const std::string& path);

struct LayeredFile {
  std::string fallback;  // the path of the stereo picture from the box's middle; empty if there is none
  std::string missing;   // the name of a fallback that cannot be read; empty otherwise
  std::string scene;     // the name of the scene that was baked; empty if unknown
  vec3 ahead{0.0f};      // the place for an object that has none: on the lowest surface around, 1.2 m ahead
};

// The fallback is directly in the file's folder, and not behind a link. Throws as read_layers_info(). Precondition:
// is_layered_scene(path).
LayeredFile read_layered_file(const std::string& path);

}  // namespace ods
