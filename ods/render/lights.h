// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The scene's lights as the kernel picks them: by their power, or by what they may bring to a surface.
#pragma once
#include <vector>

#include "ods/kernel/scene_view.h"
#include "ods/scene/scene.h"

namespace ods {

// A light that the tree is to hold.
struct TreeLight {
  int light = 0;  // its index among all lights
  Bounds bounds;
  vec3 axis{0.0f, 0.0f, 1.0f};  // unit vector: the direction that it faces, or the middle of several
  double open = 0.0;            // radians: how far from the axis it faces at most; pi: all around
  double power = 0.0;           // that it sends to the side that it faces,
  double back_power = 0.0;      // and to the other; one of them is positive
};

struct LightTree {
  std::vector<LightNode> nodes;  // the first is the root; empty: no light is in it
  std::vector<LightWay> ways;    // by the index of the light
};

// Splits where the parts are small, bright and of one direction (Conty Estevez and Kulla 2018); the same lights make
// the same tree. count: of all lights.
LightTree make_light_tree(std::vector<TreeLight> lights, size_t count);

struct LightTable {
  std::vector<Light> lights;  // each emissive triangle, each punctual light, and the environment last
  std::vector<LightPick> picks;
  LightTree tree;            // of all lights that have a place
  std::vector<char> closed;  // by mesh: emitters whose light does not leave by their backs
  std::vector<EnvironmentTexel> environment_texels;
  std::vector<AliasEntry> environment_rows;
  EnvironmentInfo environment;
  EnvironmentInfo background;       // its texels follow the environment's
  double environment_power = 0.0;   // before the limit below; per square metre of the scene's cross-section
  std::vector<Instance> instances;  // the scene's, with first_light filled in
};

// Powers are estimates: an emissive triangle's is its area times its mean emission at 16 points. An environment gets at
// most half of the picks if there are other lights, since walls may hide it. A uniform environment is left to the
// scattered rays, which find it as well as any other way could.
LightTable make_lights(const Scene& scene);

// Updates the table for a scene that set_time() changed, without looking at its environment again.
void update_lights(const Scene& scene, LightTable& table);

// Points the kernel's view at a scene and its lights, both of which must outlive it.
void set_scene(SceneView& view, const Scene& scene, const LightTable& lights);

// Walker's alias table for weights that are finite and not negative; if all are zero they count as equal.
std::vector<AliasEntry> make_alias_table(const std::vector<double>& weights);

}  // namespace ods
