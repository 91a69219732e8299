// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/sheet_glass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "ods/kernel/layer_lobes.h"
#include "ods/scene/placement.h"

namespace ods {

using glm::dvec3;

static bool is_glass(const Material& material) {
  return material.transmission > 0.0f && material.unlit == 0;
}

static bool is_sheet_glass(const Material& material) {
  return is_glass(material) && !(material.thickness > 0.0f);
}

bool is_smooth_glass(const Material& material) {
  return is_glass(material) && material.roughness * material.roughness < kSmoothAlpha;
}

static const Material& material_of(const Scene& scene, const Mesh& mesh) {
  return scene.materials[static_cast<size_t>(mesh.material)];
}

std::vector<uint> merge_positions(const Scene& scene, const Mesh& mesh) {
  const Vertex* vertices = scene.vertices.data() + mesh.first_vertex;
  const uint count = mesh.vertex_count;
  const auto before = [&](uint a, uint b) {
    const vec3 p = vertices[a].position, q = vertices[b].position;
    return std::array{p.x, p.y, p.z} < std::array{q.x, q.y, q.z};
  };
  std::vector<uint> order(count), merged(count);
  for (uint i = 0; i < count; i++) order[i] = i;
  std::sort(order.begin(), order.end(), before);
  for (uint i = 0; i < count; i++) {
    const bool same = i > 0 && vertices[order[i]].position == vertices[order[i - 1]].position;
    merged[order[i]] = same ? merged[order[i - 1]] : order[i];
  }
  return merged;
}

bool is_closed(const Scene& scene, const Mesh& mesh) {
  const Vertex* vertices = scene.vertices.data() + mesh.first_vertex;
  const std::vector<uint> merged = merge_positions(scene, mesh);
  struct Edge {
    uint low, high;
    int direction;  // 1: from low to high
    bool operator<(const Edge& other) const { return std::pair(low, high) < std::pair(other.low, other.high); }
  };
  std::vector<Edge> edges;
  edges.reserve(3 * size_t{mesh.triangle_count});
  double volume = 0.0, area = 0.0;
  const dvec3 origin(vertices[0].position);
  for (uint i = 0; i < mesh.triangle_count; i++) {
    const uvec3 corners = scene.triangles[mesh.first_triangle + i];
    dvec3 p[3];
    for (int c = 0; c < 3; c++) {
      const uint from = merged[corners[c]], to = merged[corners[(c + 1) % 3]];
      if (from != to) edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
      p[c] = dvec3(vertices[corners[c]].position) - origin;
    }
    volume += glm::dot(p[0], glm::cross(p[1], p[2])) / 6.0;
    area += 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
  }
  std::sort(edges.begin(), edges.end());
  for (size_t i = 0; i < edges.size();) {
    int balance = 0;
    size_t next = i;
    while (next < edges.size() && !(edges[i] < edges[next])) balance += edges[next++].direction;
    if (balance != 0) return false;
    i = next;
  }
  return volume > 1e-6 * std::pow(area, 1.5);  // two coincident sheets enclose nothing
}

static std::string name_of(const Scene& scene, int material) {
  const auto i = static_cast<size_t>(material);
  const bool named = i < scene.material_names.size() && !scene.material_names[i].empty();
  return named ? scene.material_names[i] : "material " + std::to_string(material);
}

// Calls function(mesh) for each mesh with a visible instance.
template <typename Function>
static void each_visible_mesh(const Scene& scene, const Function& function) {
  std::vector<char> shown(scene.meshes.size(), 0);
  for (size_t i = 0; i < scene.instances.size(); i++) {
    if (!is_hidden(scene, i)) shown[static_cast<size_t>(scene.instances[i].mesh)] = 1;
  }
  for (size_t i = 0; i < scene.meshes.size(); i++) {
    if (shown[i] != 0) function(scene.meshes[i]);
  }
}

std::vector<SheetGlass> find_sheet_glass(const Scene& scene) {
  std::map<int, SheetGlass> found;
  each_visible_mesh(scene, [&](const Mesh& mesh) {
    if (!is_sheet_glass(material_of(scene, mesh))) return;
    SheetGlass& glass = found[mesh.material];
    glass.material = mesh.material;
    glass.name = name_of(scene, mesh.material);
    (is_closed(scene, mesh) ? glass.closed_meshes : glass.open_meshes)++;
  });
  std::vector<SheetGlass> list;
  for (auto& [material, glass] : found) list.push_back(std::move(glass));
  return list;
}

std::vector<std::string> smooth_solids(const Scene& scene) {
  std::map<int, std::string> found;
  each_visible_mesh(scene, [&](const Mesh& mesh) {
    const Material& material = material_of(scene, mesh);
    if (is_smooth_glass(material) && material.thickness > 0.0f) found[mesh.material] = name_of(scene, mesh.material);
  });
  std::vector<std::string> names;
  for (auto& [material, name] : found) names.push_back(std::move(name));
  return names;
}

// Adds a copy of this material, with the same name and animation.
static int copy_material(Scene& scene, int material) {
  const auto from = static_cast<size_t>(material), to = scene.materials.size();
  scene.materials.push_back(scene.materials[from]);
  if (from < scene.material_names.size()) {
    scene.material_names.resize(to);
    scene.material_names.push_back(scene.material_names[from]);
  }
  Animation& animation = scene.animation;
  const size_t rows = animation.materials.size();
  for (size_t row = 0; row < rows; row++) {
    if (animation.materials[row].material != material) continue;
    MovingMaterial moving = animation.materials[row];
    moving.material = static_cast<int>(to);
    const int step = static_cast<int>(animation.materials.size() - row);
    animation.materials.push_back(moving);
    for (Clip& clip : animation.clips) {
      for (size_t i = 0, count = clip.tracks.size(); i < count; i++) {
        const int width = targets_per_material(clip.tracks[i].property);
        if (width == 0 || clip.tracks[i].target / width != static_cast<int>(row)) continue;
        Track track = clip.tracks[i];
        track.target += step * width;
        clip.tracks.push_back(std::move(track));
      }
    }
  }
  return static_cast<int>(to);
}

// The shortest side of the box around a mesh, which is only used to distinguish solid glass from a sheet.
static float thickness_of(const Scene& scene, const Mesh& mesh) {
  const Bounds box = mesh_bounds(scene, mesh);
  const vec3 size = box.high - box.low;
  return std::max(std::min({size.x, size.y, size.z}), 1e-6f);
}

size_t make_glass_solid(Scene& scene) {
  std::map<int, int> solid;  // sheet -> its solid copy
  size_t changed = 0;
  for (size_t i = 0; i < scene.meshes.size(); i++) {
    Mesh& mesh = scene.meshes[i];
    if (!is_sheet_glass(material_of(scene, mesh)) || !is_closed(scene, mesh)) continue;
    auto found = solid.find(mesh.material);
    if (found == solid.end()) {
      found = solid.emplace(mesh.material, copy_material(scene, mesh.material)).first;
      scene.materials.back().thickness = thickness_of(scene, mesh);
    }
    mesh.material = found->second;
    changed++;
  }
  return changed;
}

// For each vertex, the number of the connected piece of the mesh that it belongs to: one of its vertices.
static std::vector<uint> find_pieces(const Scene& scene, const Mesh& mesh) {
  std::vector<uint> parent = merge_positions(scene, mesh);
  const auto root = [&](uint vertex) {
    while (parent[vertex] != vertex) vertex = parent[vertex] = parent[parent[vertex]];
    return vertex;
  };
  for (uint i = 0; i < mesh.triangle_count; i++) {
    const uvec3 corners = scene.triangles[mesh.first_triangle + i];
    parent[root(corners.y)] = root(corners.x);
    parent[root(corners.z)] = root(corners.x);
  }
  std::vector<uint> pieces(mesh.vertex_count);
  for (uint i = 0; i < mesh.vertex_count; i++) pieces[i] = root(i);
  return pieces;
}

bool is_sheet(const Scene& scene, const Mesh& mesh) {
  constexpr double kOneSided = 0.1;  // the sum of a flat piece's areas as vectors is 1 of its area, of a dome's 0.5
  struct Piece {
    dvec3 vector_area{0.0};
    double area = 0.0, volume = 0.0;
    bool encloses_nothing() const {
      return glm::length(vector_area) > kOneSided * area || std::abs(volume) <= 1e-6 * std::pow(area, 1.5);
    }
  };
  const dvec3 origin(scene.vertices[mesh.first_vertex].position);
  const std::vector<uint> pieces = find_pieces(scene, mesh);
  std::map<uint, Piece> sums;
  for (uint i = 0; i < mesh.triangle_count; i++) {
    const uvec3 corners = scene.triangles[mesh.first_triangle + i];
    const auto at = [&](uint corner) { return dvec3(scene.vertices[mesh.first_vertex + size_t{corner}].position); };
    const dvec3 area = 0.5 * glm::cross(at(corners.y) - at(corners.x), at(corners.z) - at(corners.x));
    Piece& piece = sums[pieces[corners.x]];
    piece.vector_area += area, piece.area += glm::length(area);
    piece.volume += glm::dot(at(corners.x) - origin, area) / 3.0;
  }
  double sheets = 0.0, all = 0.0;
  for (const auto& [number, piece] : sums) {
    all += piece.area;
    if (piece.encloses_nothing()) sheets += piece.area;
  }
  return sheets > 0.5 * all;
}

// The share of light that crosses a material with the thickness in its file.
static vec3 tint_of(const Material& material) {
  const float depth = material.attenuation_distance > 0.0f ? material.thickness / material.attenuation_distance : 0.0f;
  return glm::pow(material.attenuation_color, vec3(depth));
}

size_t make_sheets_thin(Scene& scene) {
  std::map<int, int> thin;  // solid -> its thin copy
  size_t changed = 0;
  for (Mesh& mesh : scene.meshes) {
    const Material& solid = material_of(scene, mesh);
    if (!is_glass(solid) || is_sheet_glass(solid) || !is_sheet(scene, mesh)) continue;
    auto found = thin.find(mesh.material);
    if (found == thin.end()) {
      found = thin.emplace(mesh.material, copy_material(scene, mesh.material)).first;
      Material& copy = scene.materials.back();
      copy.base_color = vec4(vec3(copy.base_color) * tint_of(copy), copy.base_color.w);
      copy.thickness = 0.0f;
    }
    mesh.material = found->second;
    changed++;
  }
  return changed;
}

}  // namespace ods
