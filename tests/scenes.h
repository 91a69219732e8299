// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Small scenes with known answers, for tests.
#pragma once
#include "ods/scene/scene.h"

namespace ods {

inline Vertex corner(vec3 position, vec3 normal) {
  Vertex v{};
  v.position = position;
  v.normal = normal;
  v.color = vec4(1.0f);
  return v;
}

// A rectangle: origin, origin + a, origin + a + b, origin + b; its front is where cross(a, b) points.
inline int add_rectangle(Scene& scene, vec3 origin, vec3 a, vec3 b, int material) {
  const vec3 n = normalize(cross(a, b));
  const int mesh = add_mesh(scene, {corner(origin, n), corner(origin + a, n), corner(origin + a + b, n), corner(origin + b, n)},
                            {uvec3(0, 1, 2), uvec3(0, 2, 3)}, material);
  add_instance(scene, mesh, glm::mat4(1.0f));
  return mesh;
}

// A closed box between two corners with its faces' fronts outside.
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
  std::vector<Vertex> vertices;
  std::vector<uvec3> triangles;
  const int around = 2 * rings;
  for (int i = 0; i <= rings; i++) {
    for (int j = 0; j <= around; j++) {
      const float phi = kPi * static_cast<float>(i) / static_cast<float>(rings);
      const float theta = 2.0f * kPi * static_cast<float>(j % around) / static_cast<float>(around);
      const vec3 n(sin(phi) * cos(theta), cos(phi), -sin(phi) * sin(theta));
      vertices.push_back(corner(radius * n, n));
    }
  }
  const auto at = [&](int i, int j) { return static_cast<uint>(i * (around + 1) + j); };
  for (int i = 0; i < rings; i++) {
    for (int j = 0; j < around; j++) {
      if (i > 0) triangles.push_back(uvec3(at(i, j), at(i + 1, j), at(i, j + 1)));
      if (i < rings - 1) triangles.push_back(uvec3(at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)));
    }
  }
  const int mesh = add_mesh(scene, vertices, triangles, material);
  glm::mat4 place(1.0f);
  place[3] = vec4(center, 1.0f);
  add_instance(scene, mesh, place);
  return mesh;
}

inline int add_material(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<int>(scene.materials.size()) - 1;
}

}  // namespace ods
