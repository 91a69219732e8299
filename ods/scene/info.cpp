// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/info.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace ods {

using glm::dvec3, glm::dvec4;

double point_triangle_distance(dvec3 p, dvec3 a, dvec3 b, dvec3 c) {
  const dvec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp);
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d1 <= 0.0 && d2 <= 0.0) return glm::length(ap);
  if (d3 >= 0.0 && d4 <= d3) return glm::length(bp);
  if (d6 >= 0.0 && d5 <= d6) return glm::length(cp);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return glm::length(ap - ab * (d1 / (d1 - d3)));
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return glm::length(ap - ac * (d2 / (d2 - d6)));
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    return glm::length(bp - (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
  }
  return glm::length(ap - (ab * vb + ac * vc) / (va + vb + vc));
}

static dvec3 exact_to_world(const Instance& instance, vec3 p) {
  const dvec4 q(p, 1.0);
  return {dot(dvec4(instance.row0), q), dot(dvec4(instance.row1), q), dot(dvec4(instance.row2), q)};
}

static double box_distance(dvec3 p, dvec3 low, dvec3 high) {
  return glm::length(p - glm::clamp(p, low, high));
}

// The distance to the nearest triangle of an instance, or `nearest` if none is closer.
static double nearest_in(const Scene& scene, const Instance& instance, dvec3 camera, double nearest) {
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  std::vector<dvec3> corners(mesh.vertex_count);
  dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  for (uint i = 0; i < mesh.vertex_count; i++) {
    corners[i] = exact_to_world(instance, scene.vertices[mesh.first_vertex + i].position);
    low = min(low, corners[i]);
    high = max(high, corners[i]);
  }
  if (!(box_distance(camera, low, high) < nearest)) return nearest;
  for (uint i = 0; i < mesh.triangle_count; i++) {
    const uvec3 t = scene.triangles[mesh.first_triangle + i];
    const dvec3 a = corners[t.x], b = corners[t.y], c = corners[t.z];
    if (!(box_distance(camera, min(a, min(b, c)), max(a, max(b, c))) < nearest)) continue;
    nearest = std::min(nearest, point_triangle_distance(camera, a, b, c));
  }
  return nearest;
}

SceneInfo describe(const Scene& scene, vec3 camera_position) {
  SceneInfo info;
  info.name = scene.name;
  info.meshes = scene.meshes.size();
  info.instances = scene.instances.size();
  info.triangles = scene.triangles.size();
  info.textures = scene.textures.size();
  info.texel_bytes = scene.texels.size() * sizeof(uint);
  std::set<int> materials;
  for (const Mesh& mesh : scene.meshes) materials.insert(mesh.material);
  info.materials = materials.size();
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < scene.instances.size(); i++) {
    if (is_hidden(scene, i)) continue;
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
    info.instanced_triangles += mesh.triangle_count;
    if (is_emissive(material)) info.emissive_triangles += mesh.triangle_count;
    nearest = nearest_in(scene, instance, dvec3(camera_position), nearest);
  }
  if (std::isfinite(nearest)) info.nearest_surface = static_cast<float>(nearest);
  for (const PunctualLight& light : scene.lights) {
    (light.kind == kLightPoint  ? info.point_lights
     : light.kind == kLightSpot ? info.spot_lights
                                : info.directional_lights)++;
  }
  info.has_environment = scene.environment.radiance != vec3(0.0f);
  info.bounds = scene_bounds(scene);
  info.view_points = scene.view_points;
  for (const Clip& clip : scene.animation.clips) info.animations.push_back({clip.name, clip.end});
  info.variants = scene.variants;
  info.sheet_glass = find_sheet_glass(scene);
  info.extensions = scene.extensions;
  info.losses = scene.losses;
  info.warnings = scene.warnings;
  return info;
}

}  // namespace ods
