// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/rays/mirrors.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

namespace ods {

namespace {

constexpr float kLeastMetallic = 0.5f;
constexpr float kMostRoughness = 0.15f;
constexpr float kSameNormal = 0.9999f;  // cosine of 0.8 degrees
constexpr float kSamePlane = 2e-3f;     // metres
constexpr size_t kMostPlanes = 64;      // of an instance: one with more is a faceted thing

bool is_mirror(const Material& material) {
  return material.metallic > kLeastMetallic && material.roughness < kMostRoughness && material.unlit == 0 &&
         material.layers < 0 && material.alpha_mode == kAlphaOpaque && material.emission == vec3(0.0f) &&
         material.base_color_slot.texture < 0 && material.metallic_roughness_slot.texture < 0 &&
         material.normal_slot.texture < 0;
}

// Returns whether the corners of a triangle have its normal, so that light is reflected as by a plane.
bool is_flat(const Vertex* vertices, const uvec3& corners) {
  const vec3 a = vertices[corners.x].position;
  const vec3 across = cross(vertices[corners.y].position - a, vertices[corners.z].position - a);
  const float size = length(across);
  if (!(size > 0.0f)) return false;
  for (int i = 0; i < 3; i++) {
    if (abs(dot(vertices[corners[i]].normal, across)) < kSameNormal * size) return false;
  }
  return true;
}

// The mirrors of an instance; none if it has too many.
std::vector<FlatMirror> mirrors_of(const Scene& scene, size_t number) {
  std::vector<FlatMirror> mirrors;
  const Instance& instance = scene.instances[number];
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  const Vertex* const vertices = scene.vertices.data() + mesh.first_vertex;
  for (uint i = 0; i < mesh.triangle_count; i++) {
    const uvec3 corners = scene.triangles[mesh.first_triangle + i];
    if (!is_flat(vertices, corners)) continue;
    vec3 at[3];
    for (int k = 0; k < 3; k++) at[k] = to_world(instance, vertices[corners[k]].position);
    const vec3 normal = normalize(cross(at[1] - at[0], at[2] - at[0])) * handedness_of(instance);
    const auto found = std::ranges::find_if(mirrors, [&](const FlatMirror& mirror) {
      return dot(mirror.normal, normal) > kSameNormal && abs(height_above(mirror, at[0])) < kSamePlane &&
             abs(height_above(mirror, at[1])) < kSamePlane && abs(height_above(mirror, at[2])) < kSamePlane;
    });
    if (found == mirrors.end() && mirrors.size() == kMostPlanes) return {};
    FlatMirror& mirror = found == mirrors.end() ? mirrors.emplace_back() : *found;
    if (mirror.triangles.empty()) {
      mirror.instance = static_cast<int>(number);
      mirror.normal = normal;
      mirror.height = dot(normal, at[0]);
      mirror.has_two_sides = scene.materials[static_cast<size_t>(mesh.material)].double_sided != 0;
    }
    mirror.triangles.push_back(i);
    mirror.corners.insert(mirror.corners.end(), at, at + 3);
  }
  return mirrors;
}

}  // namespace

std::vector<FlatMirror> find_mirrors(const Scene& scene) {
  std::vector<FlatMirror> all;
  for (size_t i = 0; i < scene.instances.size(); i++) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    if (instance.role != kOrdinary || is_hidden(scene, i)) continue;
    if (!is_mirror(scene.materials[static_cast<size_t>(mesh.material)])) continue;
    std::vector<FlatMirror> some = mirrors_of(scene, i);
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

bool turn_to(FlatMirror& mirror, vec3 place) {
  if (height_above(mirror, place) > 0.0f) return true;
  mirror.normal = -mirror.normal;
  mirror.height = -mirror.height;
  return mirror.has_two_sides;
}

bool is_in_outline(const FlatMirror& mirror, vec3 on_plane, float slack) {
  for (size_t i = 0; i < mirror.corners.size(); i += 3) {
    const vec3 across = cross(mirror.corners[i + 1] - mirror.corners[i], mirror.corners[i + 2] - mirror.corners[i]);
    bool inside = true;
    for (size_t k = 0; k < 3 && inside; k++) {
      const vec3 from = mirror.corners[i + k], edge = mirror.corners[i + (k + 1) % 3] - from;
      inside = dot(cross(edge, on_plane - from), across) >= -slack * length(edge) * length(across);
    }
    if (inside) return true;
  }
  return false;
}

void keep_behind(const FlatMirror& mirror, vec3 offset, std::vector<vec3>& positions, std::vector<uvec3>& triangles) {
  std::unordered_map<uint64_t, uint> cuts;  // by edge: the vertex on the plane
  std::vector<float> heights;
  for (const vec3& position : positions) heights.push_back(height_above(mirror, position + offset));
  const auto cut = [&](uint a, uint b) {
    const uint low = std::min(a, b), high = std::max(a, b);
    const auto [found, is_new] = cuts.try_emplace(uint64_t{low} << 32 | high, static_cast<uint>(positions.size()));
    if (is_new)
      positions.push_back(mix(positions[low], positions[high], heights[low] / (heights[low] - heights[high])));
    return found->second;
  };
  std::vector<uvec3> kept;
  for (const uvec3& triangle : triangles) {
    std::vector<uint> corners;
    for (int i = 0; i < 3; i++) {
      const uint a = triangle[i], b = triangle[(i + 1) % 3];
      if (heights[a] <= 0.0f) corners.push_back(a);
      if ((heights[a] < 0.0f && heights[b] > 0.0f) || (heights[a] > 0.0f && heights[b] < 0.0f)) {
        corners.push_back(cut(a, b));
      }
    }
    for (size_t i = 2; i < corners.size(); i++) kept.emplace_back(corners[0], corners[i - 1], corners[i]);
  }
  triangles = std::move(kept);
}

}  // namespace ods
