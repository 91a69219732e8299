// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The scene's lights as the kernel picks them: by power.
#pragma once
#include <vector>

#include "ods/kernel/scene_view.h"
#include "ods/scene/scene.h"

namespace ods {

struct LightTable {
  std::vector<Light> lights;  // each glowing triangle, each punctual light, and the environment last
  std::vector<LightPick> picks;
  std::vector<EnvironmentTexel> environment_texels;
  std::vector<AliasEntry> environment_rows;
  EnvironmentInfo environment;
  double environment_power = 0.0;   // without others, for each square metre that the scene offers it
  std::vector<Instance> instances;  // the scene's, with first_light filled in
};

// Powers are estimates: a glowing triangle's is its area times the mean of its emission at 16 points. An environment
// gets at most half of the picks where other lights exist, since walls may hide it. A uniform environment is left to
// the scattered rays, which find it as well as any other way could.
LightTable make_lights(const Scene& scene);

// The same for a scene that set_time() has changed, without looking at its environment again.
void update_lights(const Scene& scene, LightTable& table);

// Points the kernel's view at a scene and its lights, both of which must outlive it.
void set_scene(SceneView& view, const Scene& scene, const LightTable& lights);

// Walker's alias table of weights: finite, not negative; all zero counts as all equal.
std::vector<AliasEntry> make_alias_table(const std::vector<double>& weights);

}  // namespace ods
