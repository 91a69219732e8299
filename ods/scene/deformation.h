// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Deforming meshes: morph targets first, then a skin, as in glTF 2.0.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "ods/kernel/scene_data.h"

namespace ods {

// Offsets added to each vertex at weight 1; empty lists add nothing.
struct MorphTarget {
  std::vector<vec3> positions;
  std::vector<vec3> normals;
  std::vector<vec3> tangents;
};

struct Influence {
  uint joint;
  float weight;
};

struct Deformation {
  int mesh = 0;              // the mesh whose vertices are rewritten
  bool flat = false;         // normals are face normals; no two triangles share a vertex
  std::vector<Vertex> rest;  // the undeformed vertices
  std::vector<MorphTarget> targets;
  int weights = -1;                   // index in Animation::weights; -1 if there are no targets
  int skin = -1;                      // index in Animation::skins, or -1
  size_t influences_per_vertex = 0;   // influences of the skin
  std::vector<Influence> influences;  // this many per vertex, with weights that add up to 1
};

// Computes the deformed vertices: positions p + sum of weight * delta, then (sum of weight * joint) p. Normals are
// transformed by the inverse transpose of that matrix, tangents by the matrix; both are normalized. Returns false, and
// writes nothing, if a coordinate of a vertex exceeds `farthest`. Preconditions: out.size() == rest.size(); one weight
// per target; `joints` contains every joint of an influence.
bool deform(const Deformation& deformation, std::span<const double> weights, std::span<const glm::dmat4> joints,
            std::span<const uvec3> triangles, float farthest, std::vector<Vertex>& out);

}  // namespace ods
