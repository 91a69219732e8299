// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Small scenes with known answers, for tests.
#pragma once
#include "ods/scene/builtin/builder.h"

namespace ods {

// A rectangle: origin, origin + a, origin + b, origin + a + b; its front is in the direction of cross(a, b).
inline int add_rectangle(Scene& scene, vec3 origin, vec3 a, vec3 b, int material) {
  return add(scene, make_quad(origin, a, b), material);
}

// Adds a material with layers.
inline int add_layered(Scene& scene, Material material, const MaterialLayers& layers) {
  material.layers = static_cast<int>(scene.material_layers.size());
  scene.material_layers.push_back(layers);
  return add_material(scene, material);
}

// A closed box between two corners, with its fronts outside; six meshes, so that the faces can be distinguished.
inline void add_box(Scene& scene, vec3 low, vec3 high, int material) {
  const vec3 x(high.x - low.x, 0, 0), y(0, high.y - low.y, 0), z(0, 0, high.z - low.z);
  add_rectangle(scene, low, y, x, material);
  add_rectangle(scene, low + z, x, y, material);
  add_rectangle(scene, low, z, y, material);
  add_rectangle(scene, low + x, y, z, material);
  add_rectangle(scene, low, x, z, material);
  add_rectangle(scene, low + y, z, x, material);
}

// A sphere of triangles, `rings` from pole to pole, with exact normals.
inline int add_sphere(Scene& scene, vec3 center, float radius, int material, int rings = 24) {
  return add(scene, make_sphere(radius, 2 * rings), material, placed(center));
}

}  // namespace ods
