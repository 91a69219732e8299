// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A scene at a time.
#pragma once
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

// What of a scene is not as it was: rows of its lists.
struct SceneChange {
  std::vector<int> instances;  // stand elsewhere, appeared or are hidden
  std::vector<int> meshes;     // have other vertices
  bool lights = false;         // punctual ones
  bool materials = false;
  bool view_points = false;
};

// Writes what the playing clips of scene.animation move, as it is at a time; what they do not move, and with no clip
// playing everything, is at rest. The
// result depends on the time alone, not on what was set before. All that ods/scene/gltf/gltf.h promises of a scene
// holds at every time, but for triangles of a mesh that is bent: those may have no area for a while, and no ray meets
// them. Instances that are scaled to nothing, or would stand more than 1e9 m from the origin, are hidden
// (Scene::hidden).
SceneChange set_time(Scene& scene, double seconds);

}  // namespace ods
