// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Short words for scenes that move: nodes, what hangs on them, and the keys of the scene's one clip.
#pragma once
#include <initializer_list>

#include "ods/scene/builtin/builder.h"

namespace ods {

// A place that can move; parent -1: in the world. Returns its row in Animation::nodes.
int add_node(Scene& scene, int parent, vec3 position);

// A mesh that goes with a node. Returns its row in Scene::meshes.
int hang(Scene& scene, const Shape& shape, int material, int node, const glm::mat4& local = glm::mat4(1.0f));

// The last mesh that was hung bends: its row in Animation::deformations.
Deformation& bend_last(Scene& scene);

// A row of Animation::materials for a material as it is.
int add_moving_material(Scene& scene, int material);

// Keys in the scene's clip. values: property_width() numbers for each time.
void add_keys(Scene& scene, Property property, int target, Interpolation interpolation, std::vector<float> times,
              std::vector<float> values);

// Keys at even times from 0 to `seconds`, both included; value(share) with share 0..1.
void add_keys(Scene& scene, Property property, int target, Interpolation interpolation, float seconds, int count,
              const std::function<std::vector<float>(float share)>& value);

// x, y, z, w of a turn about an axis, counter-clockwise seen against it.
std::vector<float> quaternion(vec3 axis, float degrees);

}  // namespace ods
