// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "ods/scene/gltf/parts.h"

namespace ods {

// Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", with glTF's signs: the bitangent is
// cross(normal, tangent) * w and points up in the picture, towards decreasing v. Exporters that bake with MikkTSpace
// store their tangents; this is for files without them. (The supported systems package no MikkTSpace library.)
void make_tangents(std::vector<Vertex>& vertices, const std::vector<uvec3>& triangles, const TextureSlot& slot) {
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

}  // namespace ods
