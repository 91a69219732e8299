// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Short functions for animated scenes: nodes, attached meshes, and the keys of the scene's one clip.
#pragma once
#include <initializer_list>

#include "ods/scene/builtin/builder.h"

namespace ods {

// Adds a movable transform; parent -1 stands for the world. Returns its index in Animation::nodes.
int add_node(Scene& scene, int parent, vec3 position);

// Attaches a mesh to a node. Returns its index in Scene::meshes.
int hang(Scene& scene, const Shape& shape, int material, int node, const glm::mat4& local = glm::mat4(1.0f));

// Makes the last attached mesh deformable, and returns its element of Animation::deformations.
Deformation& bend_last(Scene& scene);

// Adds an element to Animation::materials with the material's current values.
int add_moving_material(Scene& scene, int material);

// Adds keys to the scene's clip. values: property_width() numbers for each time.
void add_keys(Scene& scene, Property property, int target, Interpolation interpolation, std::vector<float> times,
              std::vector<float> values);

// Adds keys at even times from 0 to `seconds`, both included; value(share) with share 0..1.
void add_keys(Scene& scene, Property property, int target, Interpolation interpolation, float seconds, int count,
              const std::function<std::vector<float>(float share)>& value);

// The quaternion x, y, z, w of a rotation about an axis, counter-clockwise when looking against it.
std::vector<float> quaternion(vec3 axis, float degrees);

}  // namespace ods
