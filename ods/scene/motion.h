// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Sets a scene to a time.
#pragma once
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

// The changed parts of a scene: indices into its lists.
struct SceneChange {
  std::vector<int> instances;  // moved, appeared or were hidden
  std::vector<int> meshes;     // with new vertices
  bool lights = false;         // punctual lights changed
  bool materials = false;
  bool view_points = false;
};

// Adds another, later change that is not applied yet.
void add_change(SceneChange& sum, const SceneChange& change);

// Evaluates the playing clips of scene.animation at a time and updates the scene. Properties that they do not animate
// are at rest; without playing clips all are. The result depends on the time alone, not on earlier calls. All
// guarantees of ods/scene/gltf/gltf.h hold at every time, except that triangles of a deformed mesh may temporarily have
// no area; no ray hits those. Instances that are scaled to zero or further than 1e9 m from the origin are hidden
// (Scene::hidden), as are those of a node that is not visible; such a node's lights are dark.
SceneChange set_time(Scene& scene, double seconds);

// Returns whether the playing clips move this view point (an index in the scene), or an object to which it is attached.
bool moves_view(const Animation& animation, int view_point);

// Returns whether an instance is visible now, or at any key of any animation.
bool is_ever_visible(const Scene& scene);

// The position of a point of a surface at the time to which the scene is set, in world coordinates. hit: a ray's hit at
// any time.
vec3 point_of(const Scene& scene, const Hit& hit);

}  // namespace ods
