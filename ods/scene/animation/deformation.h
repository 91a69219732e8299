// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Meshes whose vertices move: morph targets first, then a skin, as glTF 2.0 has them.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "ods/kernel/scene_data.h"

namespace ods {

// What a weight of 1 adds to each vertex; a list is empty where it adds nothing.
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
  int mesh = 0;              // whose vertices are written
  bool flat = false;         // normals are those of the faces; no two triangles share a corner
  std::vector<Vertex> rest;  // the vertices that all starts from
  std::vector<MorphTarget> targets;
  int weights = -1;                   // which of Animation::weights; -1: no targets
  int skin = -1;                      // which of Animation::skins; -1: none
  size_t influences_per_vertex = 0;   // of a skin
  std::vector<Influence> influences;  // that many for each vertex, their weights' sum is 1
};

// Writes the vertices: positions p + sum of weight * delta, then (sum of weight * joint) p; normals turn with the
// inverse transpose of that matrix, tangents with the matrix, and both are unit vectors again. False, and nothing is
// written, where a vertex comes to lie further than `farthest` from the origin on an axis.
// Preconditions: out.size() == rest.size(); a weight for each target; joints: every joint that an influence names.
bool deform(const Deformation& deformation, std::span<const double> weights, std::span<const glm::dmat4> joints,
            std::span<const uvec3> triangles, float farthest, std::vector<Vertex>& out);

}  // namespace ods
