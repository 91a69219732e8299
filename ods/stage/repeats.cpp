// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/repeats.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <tuple>

#include "ods/base/checksum.h"

namespace ods {

namespace {

std::span<const Vertex> vertices_of(const Scene& scene, const Mesh& mesh) {
  return std::span(scene.vertices).subspan(mesh.first_vertex, mesh.vertex_count);
}

std::span<const uvec3> triangles_of(const Scene& scene, const Mesh& mesh) {
  return std::span(scene.triangles).subspan(mesh.first_triangle, mesh.triangle_count);
}

uint32_t shape_checksum(const Scene& scene, const Mesh& mesh) {
  uint32_t checksum = crc32(std::as_bytes(triangles_of(scene, mesh)));
  for (const Vertex& vertex : vertices_of(scene, mesh)) {
    checksum = crc32(std::as_bytes(std::span(&vertex.position, 1)), checksum);
  }
  return checksum;
}

bool same_shape(const Scene& scene, const Mesh& a, const Mesh& b) {
  return std::ranges::equal(triangles_of(scene, a), triangles_of(scene, b)) &&
         std::ranges::equal(vertices_of(scene, a), vertices_of(scene, b), {}, &Vertex::position, &Vertex::position);
}

// For each mesh, the index of the first one with its shape. Meshes with the same checksum but different shapes count as
// different.
std::vector<int> first_of_shape(const Scene& scene) {
  std::map<uint32_t, int> known;
  std::vector<int> first(scene.meshes.size());
  for (size_t i = 0; i < scene.meshes.size(); i++) {
    const Mesh& mesh = scene.meshes[i];
    const int found = known.emplace(shape_checksum(scene, mesh), static_cast<int>(i)).first->second;
    first[i] = same_shape(scene, scene.meshes[static_cast<size_t>(found)], mesh) ? found : static_cast<int>(i);
  }
  return first;
}

}  // namespace

std::vector<char> find_repeats(const Scene& scene) {
  using Row = std::tuple<float, float, float, float>;
  const auto row = [](vec4 v) { return Row{v.x, v.y, v.z, v.w}; };
  const std::vector<int> shapes = first_of_shape(scene);
  std::set<std::tuple<int, int, Row, Row, Row>> known;
  std::vector<char> repeats(scene.instances.size(), 0);
  for (size_t i = 0; i < scene.instances.size(); i++) {
    const Instance& instance = scene.instances[i];
    const auto index = static_cast<size_t>(instance.mesh);
    const Mesh& mesh = scene.meshes[index];
    if (is_hidden(scene, i) || instance.motion >= 0 || mesh.motion >= 0) continue;
    const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
    const bool stops_rays = material.alpha_mode == kAlphaOpaque && !(material.transmission > 0.0f);
    const int material_index = stops_rays ? -1 : mesh.material;
    const auto [place, is_new] =
        known.insert({shapes[index], material_index, row(instance.row0), row(instance.row1), row(instance.row2)});
    repeats[i] = is_new ? 0 : 1;
  }
  return repeats;
}

}  // namespace ods
