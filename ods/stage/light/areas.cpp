// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/light/areas.h"

#include <cmath>

namespace ods {

static double mesh_area(const Scene& scene, const Mesh& mesh) {
  double area = 0.0;
  for (uint i = 0; i < mesh.triangle_count; i++) {
    const uvec3 t = scene.triangles[mesh.first_triangle + i];
    const auto corner = [&](uint k) { return scene.vertices[mesh.first_vertex + k].position; };
    area += 0.5 * static_cast<double>(length(cross(corner(t.y) - corner(t.x), corner(t.z) - corner(t.x))));
  }
  return area;
}

std::vector<double> instance_areas(const Scene& scene) {
  std::vector<double> meshes(scene.meshes.size(), -1.0), areas(scene.instances.size());
  for (size_t i = 0; i < scene.instances.size(); i++) {
    if (is_hidden(scene, i)) continue;
    const Instance& instance = scene.instances[i];
    const auto mesh = static_cast<size_t>(instance.mesh);
    if (meshes[mesh] < 0.0) meshes[mesh] = mesh_area(scene, scene.meshes[mesh]);
    const vec3 a(instance.row0), b(instance.row1), c(instance.row2);
    const double volume = std::abs(static_cast<double>(dot(a, cross(b, c))));
    areas[i] = meshes[mesh] * std::pow(volume, 2.0 / 3.0);
  }
  return areas;
}

}  // namespace ods
