// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/rays/panes.h"

#include <algorithm>
#include <utility>

#include "ods/kernel/microfacets.h"
#include "ods/scene/sheet_glass.h"

namespace ods {

namespace {

constexpr float kLeastTransmission = 0.95f;
constexpr float kMostMetallic = 0.01f;

bool is_pane(const Material& material) {
  return is_smooth_glass(material) && !(material.thickness > 0.0f) && material.transmission >= kLeastTransmission &&
         material.metallic <= kMostMetallic && material.layers < 0 && material.alpha_mode == kAlphaOpaque &&
         material.emission == vec3(0.0f) && material.base_color_slot.texture < 0 &&
         material.metallic_roughness_slot.texture < 0 && material.normal_slot.texture < 0 &&
         material.transmission_slot.texture < 0;
}

const Mesh& mesh_of(const Scene& scene, size_t instance) {
  return scene.meshes[static_cast<size_t>(scene.instances[instance].mesh)];
}

// The smallest distance, along the axis where it is largest, between a triangle's box and a place.
vec3 gap_of(const vec3 (&at)[3], vec3 place) {
  const vec3 low = min(min(at[0], at[1]), at[2]), high = max(max(at[0], at[1]), at[2]);
  return max(max(low - place, place - high), vec3(0.0f));
}

void corners_at(const Scene& scene, size_t instance, uint triangle, vec3 (&at)[3]) {
  const Mesh& mesh = mesh_of(scene, instance);
  const uvec3 corners = scene.triangles[mesh.first_triangle + triangle];
  for (int i = 0; i < 3; i++) {
    at[i] = to_world(scene.instances[instance], scene.vertices[mesh.first_vertex + corners[i]].position);
  }
}

// Returns whether a triangle of the instance comes so near.
bool is_near(const Scene& scene, size_t instance, vec3 place, float room) {
  for (uint i = 0; i < mesh_of(scene, instance).triangle_count; i++) {
    vec3 at[3];
    corners_at(scene, instance, i, at);
    const vec3 normal = cross(at[1] - at[0], at[2] - at[0]);
    // Neither the triangle's box nor its plane is far away.
    const vec3 gap = gap_of(at, place);
    const float reach = room * (abs(normal.x) + abs(normal.y) + abs(normal.z));
    if (std::max({gap.x, gap.y, gap.z}) < room && abs(dot(normal, at[0] - place)) < reach) return true;
  }
  return false;
}

}  // namespace

std::vector<char> find_panes(const Scene& scene, vec3 place, float room) {
  std::vector<char> panes(scene.instances.size());
  for (size_t i = 0; i < panes.size(); i++) {
    if (scene.instances[i].role != kOrdinary || is_hidden(scene, i)) continue;
    if (!is_pane(scene.materials[static_cast<size_t>(mesh_of(scene, i).material)])) continue;
    panes[i] = is_near(scene, i, place, room) ? 0 : 1;
  }
  return panes;
}

float pane_reflectance(const Material& material, float cosine) {
  return fresnel_dielectric(std::clamp(cosine, 1e-5f, 1.0f), material.ior) * material.transmission;
}

float pane_alpha(const Material& material, float cosine) {
  const float tint = (material.base_color.x + material.base_color.y + material.base_color.z) / 3.0f;
  const float passed = 1.0f - fresnel_dielectric(std::clamp(cosine, 1e-5f, 1.0f), material.ior);
  return std::clamp(1.0f - tint * passed * material.transmission, 0.0f, 1.0f);
}

PaneTriangles pane_triangles(const Scene& scene, int instance, bool backs, vec3 place) {
  PaneTriangles pane;
  const size_t number = static_cast<size_t>(instance);
  const Mesh& mesh = mesh_of(scene, number);
  if (backs && scene.materials[static_cast<size_t>(mesh.material)].double_sided == 0) return pane;
  for (uint i = 0; i < mesh.vertex_count; i++) {
    const vec3 local = scene.vertices[mesh.first_vertex + i].position;
    pane.positions.push_back(to_world(scene.instances[number], local) - place);
  }
  const bool flips = handedness_of(scene.instances[number]) < 0.0f;
  pane.nearest = kFarAway;
  const std::vector<uint> merged = merge_positions(scene, mesh);
  for (uint i = 0; i < mesh.triangle_count; i++) {
    uvec3 corners = scene.triangles[mesh.first_triangle + i];
    for (int k = 0; k < 3; k++) corners[k] = merged[corners[k]];
    if (flips != backs) std::swap(corners.y, corners.z);
    vec3 at[3];
    for (int k = 0; k < 3; k++) at[k] = pane.positions[corners[k]];
    if (dot(cross(at[1] - at[0], at[2] - at[0]), at[0]) >= 0.0f) continue;
    pane.triangles.push_back(corners);
    pane.nearest = std::min(pane.nearest, length(gap_of(at, vec3(0.0f))));
  }
  return pane;
}

}  // namespace ods
