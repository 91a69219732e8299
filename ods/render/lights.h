// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The scene's lights in the form in which the kernel picks them: by their power, or by their possible contribution to a
// surface.
#pragma once
#include <vector>

#include "ods/kernel/scene_view.h"
#include "ods/scene/scene.h"

namespace ods {

// A light of the tree.
struct TreeLight {
  int light = 0;  // its index among all lights
  Bounds bounds;
  vec3 axis{0.0f, 0.0f, 1.0f};  // unit vector: the direction that it faces, or the middle of several
  double open = 0.0;            // radians: maximum angle between the axis and its directions; pi for all directions
  double power = 0.0;           // power sent to the side that it faces,
  double back_power = 0.0;      // power sent to the opposite side; one of them is positive
};

struct LightTree {
  std::vector<LightNode> nodes;  // the first is the root; empty if no light is in it
  std::vector<LightWay> ways;    // indexed by light
};

// Splits so that the parts are small and have similar directions, weighted by power (Conty Estevez and Kulla 2018). The
// same lights always give the same tree. count: number of all lights.
LightTree make_light_tree(std::vector<TreeLight> lights, size_t count);

struct LightTable {
  std::vector<Light> lights;  // each emissive triangle, each punctual light, and the environment last
  std::vector<LightPick> picks;
  LightTree tree;            // all lights with a position
  std::vector<char> closed;  // by mesh: emitters that emit no light from their back sides
  std::vector<EnvironmentTexel> environment_texels;
  std::vector<AliasEntry> environment_rows;
  EnvironmentInfo environment;
  EnvironmentInfo background;       // its texels follow the environment's
  double environment_power = 0.0;   // before the limit described below; per square metre of the scene's cross-section
  std::vector<Instance> instances;  // the scene's, with first_light filled in
};

// Powers are estimates: an emissive triangle's is its area times its mean emission at 16 points. An environment gets at
// most half of the picks if there are other lights, since walls may hide it. A uniform environment is not sampled as a
// light, because scattered rays find it equally well.
LightTable make_lights(const Scene& scene);

// A table for rays that only look for surfaces.
LightTable without_lights(const Scene& scene);

// Updates the table for a scene that set_time() changed, without reading its environment again.
void update_lights(const Scene& scene, LightTable& table);

// Points the kernel's view at a scene and its lights, both of which must outlive it.
void set_scene(SceneView& view, const Scene& scene, const LightTable& lights);

// Walker's alias table for weights that are finite and not negative; if all are zero they count as equal.
std::vector<AliasEntry> make_alias_table(const std::vector<double>& weights);

}  // namespace ods
