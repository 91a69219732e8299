// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "ods/scene/gltf/parts.h"

namespace ods {

static bool within(vec3 p, float limit) {  // false for NaN
  return std::abs(p.x) <= limit && std::abs(p.y) <= limit && std::abs(p.z) <= limit;
}

// Normalized, or zero if there is no direction. In double, because the square of a small float underflows.
static vec3 direction(vec3 v) {
  const glm::dvec3 d(v);
  const double size = glm::length(d);
  return std::isfinite(size) && size > 1e-30 ? vec3(d / size) : vec3(0.0f);
}

// --- triangles

namespace {

enum Mode { kPoints = 0, kTriangles = 4, kStrip = 5, kFan = 6 };  // primitive modes; those between are lines

}  // namespace

// Triangle corners, as indices of the file's vertices.
static std::vector<uvec3> make_triangles(const std::vector<uint>& corners, int mode) {
  std::vector<uvec3> triangles;
  const size_t count = corners.size();
  if (mode == kTriangles) {
    for (size_t i = 0; i + 2 < count; i += 3) triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
  } else if (mode == kStrip) {
    for (size_t i = 0; i + 2 < count; i++) {
      triangles.emplace_back(corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]);
    }
  } else {
    for (size_t i = 0; i + 2 < count; i++) triangles.emplace_back(corners[i + 1], corners[i + 2], corners[0]);
  }
  return triangles;
}

// accessor: the primitive's indices.
static std::vector<uint> read_corners(GltfFile& file, int accessor, size_t vertex_count) {
  const AccessorView indices = open_accessor(file, accessor);
  const size_t count = accessor == -1 ? vertex_count : indices.count;
  if (accessor != -1 && (!is_unsigned(indices.component_type) || indices.components != 1)) {
    fail(file, fmt::format("accessor {} holds indices, but not unsigned integers", accessor));
  }
  spend(file, count);
  std::vector<uint> corners(count);
  for (size_t i = 0; i < count; i++) {
    corners[i] = accessor == -1 ? static_cast<uint>(i) : indices.index_at(i);
    if (corners[i] >= vertex_count) {
      fail(file, fmt::format("accessor {} has the index {}, but there are {} vertices; the file is damaged", accessor,
                             corners[i], vertex_count));
    }
  }
  return corners;
}

// Returns the triangle corners of Draco data, like read_corners().
static std::vector<uint> take_corners(GltfFile& file, DracoMesh& mesh) {
  spend(file, mesh.corners.size());
  for (const uint corner : mesh.corners) {
    if (corner >= mesh.vertex_count) fail(file, "has Draco data with an index out of range; the file is damaged");
  }
  return std::move(mesh.corners);
}

// Drops triangles that no ray can hit. Returns how many had a non-finite corner.
static size_t drop_bad_triangles(const AccessorView& positions, std::vector<uvec3>& triangles) {
  constexpr float kSmallest = 1e-18f;  // m2; below this, squared areas underflow a float
  size_t broken = 0;
  std::erase_if(triangles, [&](const uvec3& t) {
    const vec3 a(positions.at(t.x)), b(positions.at(t.y)), c(positions.at(t.z));
    if (!within(a, kFarthest) || !within(b, kFarthest) || !within(c, kFarthest)) {
      broken++;
      return true;
    }
    return !(glm::length(cross(b - a, c - a)) > kSmallest);
  });
  return broken;
}

// --- vertices

namespace {

struct Attributes {
  AccessorView position, normal, tangent, uv0, uv1, color;
};

}  // namespace

AccessorView read_attribute(GltfFile& file, const JsonValue& attributes, const char* name, int components,
                            size_t count) {
  const int accessor = index_in(file, attributes, name);
  const auto compressed = file.draco.find(&attributes);
  const bool is_compressed = compressed != file.draco.end() && compressed->second.attributes.contains(name);
  const AccessorView attribute = is_compressed ? compressed->second.attributes.at(name) : open_accessor(file, accessor);
  if (attribute.count == 0) return attribute;
  if (attribute.components < components || attribute.components > 4) {
    fail(file,
         fmt::format("accessor {} has {} components, {} needs {}", accessor, attribute.components, name, components));
  }
  if (count != 0 && attribute.count != count) {
    fail(file, fmt::format("a primitive has {} positions, but {} values of {}", count, attribute.count, name));
  }
  return attribute;
}

static vec2 read_uv(const AccessorView& attribute, size_t i) {
  if (attribute.count == 0) return vec2(0.0f);
  const vec4 uv = attribute.at(i);
  auto legal = [](float x) { return std::isnan(x) ? 0.0f : clamp(x, -kLargestUv, kLargestUv); };
  return vec2(legal(uv.x), legal(uv.y));
}

static Vertex read_vertex(const Attributes& attributes, size_t i) {
  Vertex vertex;
  vertex.position = vec3(attributes.position.at(i));
  vertex.normal = attributes.normal.count == 0 ? vec3(0.0f) : direction(vec3(attributes.normal.at(i)));
  vertex.tangent = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  if (attributes.tangent.count != 0) {
    const vec4 tangent = attributes.tangent.at(i);
    vertex.tangent = vec4(direction(vec3(tangent)), tangent.w < 0.0f ? -1.0f : 1.0f);
  }
  vertex.uv0 = read_uv(attributes.uv0, i);
  vertex.uv1 = read_uv(attributes.uv1, i);
  vertex.color = vec4(1.0f);
  if (attributes.color.count != 0) {
    const vec4 color = attributes.color.at(i);
    for (int c = 0; c < 4; c++) vertex.color[c] = std::isfinite(color[c]) ? clamp(color[c], 0.0f, 1.0f) : 1.0f;
  }
  return vertex;
}

namespace {

struct Geometry {
  std::vector<Vertex> vertices;
  std::vector<uvec3> triangles;
  std::vector<uint> order;  // indices in the file
};

}  // namespace

// Keeps only vertices that triangles use, because many primitives may share one long list.
static std::vector<uint> renumber(std::vector<uvec3>& triangles) {
  std::vector<uint> used;
  used.reserve(triangles.size() * 3);
  for (const uvec3& t : triangles) used.insert(used.end(), {t.x, t.y, t.z});
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  auto place = [&](uint i) { return static_cast<uint>(std::lower_bound(used.begin(), used.end(), i) - used.begin()); };
  for (uvec3& t : triangles) t = uvec3(place(t.x), place(t.y), place(t.z));
  return used;
}

// Like renumber(), for a list of vertices that belongs to the primitive alone, so that a table of its length costs
// little.
static std::vector<uint> renumber_own(std::vector<uvec3>& triangles, size_t vertex_count) {
  std::vector<uint> places(vertex_count, 0), used;
  for (const uvec3& t : triangles) places[t.x] = places[t.y] = places[t.z] = 1;
  for (size_t i = 0; i < vertex_count; i++) {
    if (places[i] == 0) continue;
    places[i] = static_cast<uint>(used.size());
    used.push_back(static_cast<uint>(i));
  }
  for (uvec3& t : triangles) t = uvec3(places[t.x], places[t.y], places[t.z]);
  return used;
}

static Geometry gather(const Attributes& attributes, std::vector<uvec3> triangles, bool own_vertices) {
  Geometry geometry;
  geometry.order = own_vertices ? renumber_own(triangles, attributes.position.count) : renumber(triangles);
  geometry.order.shrink_to_fit();
  geometry.triangles = std::move(triangles);
  geometry.vertices.reserve(geometry.order.size());
  for (const uint i : geometry.order) geometry.vertices.push_back(read_vertex(attributes, i));
  return geometry;
}

// --- repairs

// Twice the area, along the normal of a counter-clockwise triangle.
static vec3 area_vector(const Geometry& geometry, const uvec3& t) {
  const vec3 a = geometry.vertices[t.x].position;
  return cross(geometry.vertices[t.y].position - a, geometry.vertices[t.z].position - a);
}

static void make_flat(Geometry& geometry) {
  Geometry flat;
  for (const uvec3& t : geometry.triangles) {
    const uint first = static_cast<uint>(flat.vertices.size());
    const vec3 normal = direction(area_vector(geometry, t));
    for (int c = 0; c < 3; c++) {
      flat.vertices.push_back(geometry.vertices[t[c]]);
      flat.order.push_back(geometry.order[t[c]]);
      flat.vertices.back().normal = normal;
      flat.vertices.back().tangent = vec4(0.0f, 0.0f, 0.0f, 1.0f);
    }
    flat.triangles.emplace_back(first, first + 1, first + 2);
  }
  geometry = std::move(flat);
}

// Replaces zero-length normals by the mean of the adjacent faces'.
static void repair_normals(Geometry& geometry) {
  std::vector<Vertex>& vertices = geometry.vertices;
  if (std::none_of(vertices.begin(), vertices.end(), [](const Vertex& v) { return v.normal == vec3(0.0f); })) return;
  std::vector<vec3> means(vertices.size(), vec3(0.0f));
  for (const uvec3& t : geometry.triangles) {
    for (int c = 0; c < 3; c++) means[t[c]] += direction(area_vector(geometry, t));
  }
  for (size_t i = 0; i < vertices.size(); i++) {
    if (vertices[i].normal != vec3(0.0f)) continue;
    const vec3 mean = direction(means[i]);
    vertices[i].normal = mean == vec3(0.0f) ? vec3(0.0f, 1.0f, 0.0f) : mean;
  }
}

// Gives vertices without a tangent one along u of the normal map's coordinates. Source: Lengyel, "Computing Tangent
// Space Basis Vectors for an Arbitrary Mesh", with glTF's signs: the bitangent is cross(normal, tangent) * w and points
// up in the picture, towards decreasing v. Exporters that bake with MikkTSpace store their tangents; this is for files
// without them. (The supported systems package no MikkTSpace library.)
static void make_tangents(std::vector<Vertex>& vertices, const std::vector<uvec3>& triangles, const TextureSlot& slot) {
  auto uv = [&](const Vertex& vertex) {
    const vec2 p = slot.uv_set == 1 ? vertex.uv1 : vertex.uv0;
    return glm::dvec2(slot.offset + p.x * slot.axis_u + p.y * slot.axis_v);
  };
  std::vector<glm::dvec3> along_u(vertices.size(), glm::dvec3(0.0)), up(along_u);
  for (const uvec3& t : triangles) {
    const Vertex &a = vertices[t.x], &b = vertices[t.y], &c = vertices[t.z];
    const glm::dvec3 edge1(b.position - a.position), edge2(c.position - a.position);
    const glm::dvec2 step1 = uv(b) - uv(a), step2 = uv(c) - uv(a);
    const double area = step1.x * step2.y - step2.x * step1.y;
    if (area == 0.0) continue;
    const glm::dvec3 u = (edge1 * step2.y - edge2 * step1.y) * std::copysign(1.0, area);
    const glm::dvec3 v = (edge2 * step1.x - edge1 * step2.x) * std::copysign(1.0, area);
    for (int k = 0; k < 3; k++) {
      along_u[t[k]] += u;
      up[t[k]] -= v;
    }
  }
  for (size_t i = 0; i < vertices.size(); i++) {
    if (vec3(vertices[i].tangent) != vec3(0.0f)) continue;
    const glm::dvec3 normal(vertices[i].normal);
    const glm::dvec3 tangent = along_u[i] - normal * glm::dot(normal, along_u[i]);
    const double size = glm::length(tangent);
    if (!(size > 1e-30)) continue;
    const float side = glm::dot(glm::cross(normal, tangent), up[i]) < 0.0 ? -1.0f : 1.0f;
    vertices[i].tangent = vec4(vec3(tangent / size), side);
  }
}

// --- meshes

// The texture coordinates that a material's tangents follow: those of its normal map, its clearcoat's normal map, or
// its anisotropy. Null if it needs no tangents.
static const TextureSlot* slot_of_tangents(const GltfFile& file, const Scene& scene, int index) {
  const Material& material = scene.materials[static_cast<size_t>(index)];
  if (material.normal_slot.texture != -1) return &material.normal_slot;
  if (material.layers < 0) return nullptr;
  const MaterialLayers& layers = scene.material_layers[static_cast<size_t>(material.layers)];
  if (layers.clearcoat_normal_slot.texture != -1) return &layers.clearcoat_normal_slot;
  const auto i = static_cast<size_t>(index);
  const bool moves = i < file.moving_layers.size() && file.moving_layers[i] != 0;
  return moves || layers.anisotropy > 0.0f ? &layers.anisotropy_slot : nullptr;
}

// The file's index of a primitive's material, or -1. The first mapping that contains the chosen variant counts.
static int material_of(GltfFile& file, const JsonValue& primitive) {
  if (file.variant != -1) {
    for (const JsonValue& mapping : extension(primitive, "KHR_materials_variants")["mappings"]) {
      const std::vector<int> variants = indices(file, mapping, "variants");
      spend(file, 1 + variants.size());  // many nodes may share a mesh that deforms
      if (std::find(variants.begin(), variants.end(), file.variant) != variants.end()) {
        return index_in(file, mapping, "material");
      }
    }
  }
  return index_in(file, primitive, "material");
}

// Returns whether a primitive refers to an accessor without elements.
static bool is_empty(const GltfFile& file, const JsonValue& parent, const char* key) {
  const int accessor = index_in(file, parent, key);
  return accessor != -1 && size_in(file, record(file, file.accessors, accessor, "accessor"), "count") == 0;
}

// Appends the Scene mesh of one primitive and returns its index, or -1 if no part of it is visible.
static int read_primitive(GltfFile& file, Scene& scene, const JsonValue& primitive, const Deformers& bending) {
  const int mode = integer(file, primitive, "mode", kTriangles);
  if (mode < kPoints || mode > kFan) fail(file, fmt::format("primitive mode {} does not exist", mode));
  if (mode < kTriangles) {
    (mode == kPoints ? file.points : file.lines).insert(&primitive);
    return -1;
  }
  const JsonValue& listed = primitive["attributes"];
  if (index_in(file, listed, "POSITION") == -1) {
    warn(scene, "a primitive without positions is ignored");
    return -1;
  }
  if (is_empty(file, listed, "POSITION") || is_empty(file, primitive, "indices")) {
    warn(scene, "primitives without any vertex or index are left out");
    return -1;
  }
  const int none = static_cast<int>(file.materials.size());
  const int named = material_of(file, primitive), material = named == -1 ? none : named;
  if (material < 0 || material > none)
    fail(file, fmt::format("material {} does not exist; the file is damaged", material));

  Attributes attributes;
  attributes.position = read_attribute(file, listed, "POSITION", 3, 0);
  const size_t count = attributes.position.count;
  attributes.normal = read_attribute(file, listed, "NORMAL", 3, count);
  attributes.tangent = read_attribute(file, listed, "TANGENT", 4, count);
  attributes.uv0 = read_attribute(file, listed, "TEXCOORD_0", 2, count);
  attributes.uv1 = read_attribute(file, listed, "TEXCOORD_1", 2, count);
  attributes.color = read_attribute(file, listed, "COLOR_0", 3, count);

  const auto compressed = file.draco.find(&listed);
  std::vector<uvec3> triangles =
      compressed != file.draco.end()
          ? make_triangles(take_corners(file, compressed->second), kTriangles)
          : make_triangles(read_corners(file, index_in(file, primitive, "indices"), count), mode);
  if (drop_bad_triangles(attributes.position, triangles) > 0) {
    warn(scene, "triangles with a corner that is not finite, or too far away, are left out");
  }
  if (triangles.empty()) return -1;
  const bool flat = attributes.normal.count == 0;
  Geometry geometry = gather(attributes, std::move(triangles), compressed != file.draco.end());
  const PrimitiveSource source{listed, primitive["targets"], count, geometry.order};
  const bool deforms = bends(source, bending);
  attributes = {};
  if (!deforms) file.draco.erase(&listed);
  if (flat) make_flat(geometry);
  repair_normals(geometry);
  const TextureSlot* const tangent_slot = slot_of_tangents(file, scene, material);
  if (tangent_slot) make_tangents(geometry.vertices, geometry.triangles, *tangent_slot);
  const int index = add_mesh(scene, std::move(geometry.vertices), std::move(geometry.triangles), material);
  if (deforms) read_deformation(file, scene, source, bending, index, flat);
  file.draco.erase(&listed);
  return index;
}

std::vector<int> read_mesh(GltfFile& file, Scene& scene, int mesh, const Deformers& bending) {
  std::vector<int> meshes;
  const JsonValue& source = record(file, file.meshes, mesh, "mesh");
  decode_mesh(file, mesh);
  for (const JsonValue& primitive : source["primitives"]) {
    const int index = read_primitive(file, scene, primitive, bending);
    if (index != -1) meshes.push_back(index);
  }
  return meshes;
}

}  // namespace ods
