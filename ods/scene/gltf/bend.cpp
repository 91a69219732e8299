// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "ods/scene/gltf/parts.h"

namespace ods {

bool bends(const PrimitiveSource& primitive, const Deformers& bending) {
  return (bending.weights != -1 && primitive.targets.size() > 0) ||
         (bending.skin != -1 && !primitive.attributes["JOINTS_0"].is_null());
}

// --- morph targets

static std::vector<vec3> read_deltas(GltfFile& file, const PrimitiveSource& primitive, const JsonValue& target,
                                     const char* name) {
  const AccessorView deltas = read_attribute(file, target, name, 3, primitive.vertex_count);
  if (deltas.count == 0) return {};
  spend(file, primitive.order.size());
  std::vector<vec3> values;
  values.reserve(primitive.order.size());
  for (const uint i : primitive.order) {
    const vec3 delta(deltas.at(i));
    for (int c = 0; c < 3; c++) {
      if (!std::isfinite(delta[c])) fail(file, fmt::format("a morph target's {} is not finite", name));
    }
    values.push_back(delta);
  }
  return values;
}

// --- skins

static void read_set(GltfFile& file, const PrimitiveSource& primitive, int set, size_t joints, Deformation& result) {
  const std::string names[2] = {fmt::format("JOINTS_{}", set), fmt::format("WEIGHTS_{}", set)};
  const AccessorView which = read_attribute(file, primitive.attributes, names[0].c_str(), 4, primitive.vertex_count);
  const AccessorView weights = read_attribute(file, primitive.attributes, names[1].c_str(), 4, primitive.vertex_count);
  if (which.count == 0 || weights.count == 0) return;
  for (size_t i = 0; i < primitive.order.size(); i++) {
    const vec4 joint = which.at(primitive.order[i]), weight = weights.at(primitive.order[i]);
    for (int c = 0; c < 4; c++) {
      const bool counts = std::isfinite(weight[c]) && weight[c] > 0.0f;
      if (counts && !(joint[c] >= 0.0f && joint[c] < static_cast<float>(joints))) {
        fail(file,
             fmt::format("a vertex refers to joint {} of a skin that has {}; the file is damaged", joint[c], joints));
      }
      const size_t place = i * result.influences_per_vertex + static_cast<size_t>(4 * set + c);
      result.influences[place] = {counts ? static_cast<uint>(joint[c]) : 0u, counts ? std::min(weight[c], 1e6f) : 0.0f};
    }
  }
}

static void read_influences(GltfFile& file, const PrimitiveSource& primitive, size_t joints, Deformation& result) {
  const bool second = !primitive.attributes["JOINTS_1"].is_null();
  result.influences_per_vertex = second ? 8 : 4;
  spend(file, primitive.order.size());
  result.influences.resize(primitive.order.size() * result.influences_per_vertex);
  for (int set = 0; set < (second ? 2 : 1); set++) read_set(file, primitive, set, joints, result);
  // The specification requires sums of 1; a vertex without weights follows the first joint.
  for (auto at = result.influences.begin(); at != result.influences.end();) {
    const auto end = at + static_cast<std::ptrdiff_t>(result.influences_per_vertex);
    float sum = 0.0f;
    for (auto i = at; i != end; ++i) sum += i->weight;
    for (auto i = at; i != end; ++i) i->weight = sum > 0.0f ? i->weight / sum : (i == at ? 1.0f : 0.0f);
    at = end;
  }
}

int read_skin(GltfFile& file, Scene& scene, int index, const std::vector<int>& rows) {
  const JsonValue& source = record(file, file.skins, index, "skin");
  const std::vector<int> joints = indices(file, source, "joints");
  if (joints.empty()) fail(file, fmt::format("skin {} has no joints; the file is damaged", index));
  const AccessorView matrices = open_accessor(file, index_in(file, source, "inverseBindMatrices"));
  if (matrices.count != 0 && (matrices.components != 16 || matrices.count < joints.size())) {
    fail(file, fmt::format("skin {} has {} joints, but another number of matrices; the file is damaged", index,
                           joints.size()));
  }
  spend(file, joints.size());
  Skin skin;
  for (size_t i = 0; i < joints.size(); i++) {
    skin.joints.push_back(element(file, rows, joints[i], "node"));
    glm::dmat4 matrix(1.0);
    for (int k = 0; k < 16 && matrices.count != 0; k++) {
      matrix[k / 4][k % 4] = static_cast<double>(matrices.number_at(i, k));
    }
    if (!is_bounded(matrix)) fail(file, fmt::format("skin {} has a matrix that is not finite, or too large", index));
    skin.inverse_bind.push_back(matrix);
  }
  scene.animation.skins.push_back(std::move(skin));
  return static_cast<int>(scene.animation.skins.size()) - 1;
}

// --- both

void read_deformation(GltfFile& file, Scene& scene, const PrimitiveSource& primitive, const Deformers& bending,
                      int mesh, bool flat) {
  Animation& animation = scene.animation;
  const Mesh& stored = scene.meshes[static_cast<size_t>(mesh)];
  const auto first = scene.vertices.begin() + stored.first_vertex;
  Deformation result;
  result.mesh = mesh;
  result.flat = flat;
  result.rest.assign(first, first + stored.vertex_count);
  if (bending.weights != -1) {
    result.weights = bending.weights;
    for (const JsonValue& target : primitive.targets) {
      spend(file, 1);
      result.targets.push_back({read_deltas(file, primitive, target, "POSITION"),
                                read_deltas(file, primitive, target, "NORMAL"),
                                read_deltas(file, primitive, target, "TANGENT")});
    }
    if (result.targets.size() > animation.weights[static_cast<size_t>(bending.weights)].size()) {
      fail(file, "has a mesh whose primitives differ in their morph targets; the file is damaged");
    }
  }
  if (bending.skin != -1 && !primitive.attributes["JOINTS_0"].is_null()) {
    result.skin = bending.skin;
    read_influences(file, primitive, animation.skins[static_cast<size_t>(bending.skin)].joints.size(), result);
  }
  animation.deformations.push_back(std::move(result));
}

}  // namespace ods
