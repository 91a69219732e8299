// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/deformation.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

#include "ods/base/unit_vector.h"

namespace ods {

using glm::dmat3, glm::dmat4, glm::dvec3, glm::dvec4;

namespace {

constexpr size_t kVerticesPerTask = 4096;

// Returns the vector normalized, or `before` if it has no direction.
vec3 unit_or(dvec3 v, vec3 before) {
  return vec3(unit(v, dvec3(before)));
}

struct MovedVertex {
  dvec3 position, normal, tangent;
};

MovedVertex morphed(const Deformation& deformation, std::span<const double> weights, size_t i) {
  const Vertex& rest = deformation.rest[i];
  MovedVertex moved{dvec3(rest.position), dvec3(rest.normal), dvec3(rest.tangent)};
  for (size_t k = 0; k < deformation.targets.size(); k++) {
    const MorphTarget& target = deformation.targets[k];
    if (weights[k] == 0.0) continue;
    if (!target.positions.empty()) moved.position += weights[k] * dvec3(target.positions[i]);
    if (!target.normals.empty()) moved.normal += weights[k] * dvec3(target.normals[i]);
    if (!target.tangents.empty()) moved.tangent += weights[k] * dvec3(target.tangents[i]);
  }
  return moved;
}

void apply_skin(const Deformation& deformation, std::span<const dmat4> joints, size_t i, MovedVertex& moved) {
  dmat4 matrix(0.0);
  const size_t count = deformation.influences_per_vertex;
  for (size_t k = 0; k < count; k++) {
    const Influence& influence = deformation.influences[i * count + k];
    if (influence.weight != 0.0f) matrix += static_cast<double>(influence.weight) * joints[influence.joint];
  }
  const dvec3 x(matrix[0]), y(matrix[1]), z(matrix[2]);
  // The cofactor matrix: proportional to the inverse transpose, and defined even for singular matrices.
  const dmat3 normals(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
  moved.position = dvec3(matrix * dvec4(moved.position, 1.0));
  moved.normal = normals * moved.normal;
  moved.tangent = dmat3(matrix) * moved.tangent;
}

bool write_vertex(const Vertex& rest, const MovedVertex& moved, float farthest, Vertex& out) {
  out = rest;
  out.position = vec3(moved.position);
  out.normal = unit_or(moved.normal, rest.normal);
  if (vec3(rest.tangent) != vec3(0.0f)) {
    const dvec3 normal(out.normal);
    const dvec3 across = moved.tangent - normal * glm::dot(normal, moved.tangent);
    out.tangent = vec4(unit_or(across, vec3(rest.tangent)), rest.tangent.w);
  }
  const vec3 p = abs(out.position);
  return p.x <= farthest && p.y <= farthest && p.z <= farthest;  // false for NaN
}

void make_flat(std::span<const uvec3> triangles, std::vector<Vertex>& vertices) {
  for (const uvec3& t : triangles) {
    const dvec3 a(vertices[t.x].position), b(vertices[t.y].position), c(vertices[t.z].position);
    const vec3 normal = unit_or(glm::cross(b - a, c - a), vertices[t.x].normal);
    for (int corner = 0; corner < 3; corner++) vertices[t[corner]].normal = normal;
  }
}

}  // namespace

bool deform(const Deformation& deformation, std::span<const double> weights, std::span<const dmat4> joints,
            std::span<const uvec3> triangles, float farthest, std::vector<Vertex>& out) {
  assert(out.size() == deformation.rest.size() && weights.size() >= deformation.targets.size());
  std::vector<Vertex> vertices(out.size());
  std::atomic<bool> sound = true;
  tbb::parallel_for(tbb::blocked_range<size_t>(0, out.size(), kVerticesPerTask), [&](const auto& range) {
    for (size_t i = range.begin(); i < range.end(); i++) {
      MovedVertex moved = morphed(deformation, weights, i);
      if (deformation.skin != -1) apply_skin(deformation, joints, i, moved);
      if (!write_vertex(deformation.rest[i], moved, farthest, vertices[i])) sound = false;
    }
  });
  if (!sound) return false;
  if (deformation.flat) make_flat(triangles, vertices);
  out = std::move(vertices);
  return true;
}

}  // namespace ods
