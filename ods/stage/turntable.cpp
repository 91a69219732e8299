// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/turntable.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "ods/scene/placement.h"

namespace ods {

namespace {

using glm::dmat4, glm::dvec3, glm::dvec4;

constexpr int kKeysPerTurn = 8;

dmat4 moved_by(const dvec3& way) {
  dmat4 matrix(1.0);
  matrix[3] = dvec4(way, 1.0);
  return matrix;
}

bool moves_a_node(Property property) {
  return property == Property::kTranslation || property == Property::kRotation || property == Property::kScale;
}

// Appends the table's node, and copies of all nodes, as its descendants. Returns the table; the copy of node i is table
// + 1 + i. Lights and view points remain on the original nodes.
int add_table(Animation& animation, const dvec3& middle) {
  const int table = static_cast<int>(animation.nodes.size());
  std::vector<MovingNode> standing = animation.nodes;
  animation.nodes.emplace_back().before = moved_by(middle);
  for (MovingNode& node : standing) {
    if (node.parent == -1) node.before = moved_by(-middle) * node.before;
    node.parent = node.parent == -1 ? table : node.parent + table + 1;
    animation.nodes.push_back(node);
  }
  for (Clip& clip : animation.clips) {
    std::vector<Track> copies;
    for (const Track& track : clip.tracks) {
      if (moves_a_node(track.property)) copies.emplace_back(track).target += table + 1;
    }
    clip.tracks.insert(clip.tracks.end(), copies.begin(), copies.end());
  }
  for (Skin& skin : animation.skins) {
    for (int& joint : skin.joints) joint += table + 1;
  }
  return table;
}

dmat4 matrix_of(const Instance& instance) {
  return glm::transpose(dmat4(dvec4(instance.row0), dvec4(instance.row1), dvec4(instance.row2), dvec4(0, 0, 0, 1)));
}

void put_on_table(Scene& scene, int table, const dvec3& middle) {
  Animation& animation = scene.animation;
  std::vector<char> moves(scene.instances.size());
  for (MovingInstance& moving : animation.instances) {
    moves[static_cast<size_t>(moving.instance)] = 1;
    const bool skinned =
        moving.deformation != -1 && animation.deformations[static_cast<size_t>(moving.deformation)].skin != -1;
    if (skinned) continue;  // its joints turn with the table
    if (moving.node == -1) {
      moving.local = moved_by(-middle) * moving.local;
      moving.node = table;
    } else {
      moving.node += table + 1;
    }
  }
  for (size_t i = 0; i < scene.instances.size() - scene.supplied; i++) {
    const Instance& instance = scene.instances[i];
    if (moves[i] || instance.role != kOrdinary || is_hidden(scene, i)) continue;
    const Bounds box = mesh_bounds(scene, scene.meshes[static_cast<size_t>(instance.mesh)]);
    animation.instances.push_back(
        {static_cast<int>(i), table, -1, moved_by(-middle) * matrix_of(instance), box.low, box.high});
  }
}

}  // namespace

void turn_object(Scene& scene, vec3 middle, double turns, double seconds, double end) {
  assert(seconds > 0.0 && std::abs(turns) / seconds * end <= kMaxTurns);
  if (turns == 0.0) return;
  Animation& animation = scene.animation;
  const int table = add_table(animation, dvec3(middle));
  put_on_table(scene, table, dvec3(middle));
  Clip& clip = animation.clips.emplace_back();
  clip.name = "turntable";
  clip.end = seconds;
  Track& track = clip.tracks.emplace_back();
  track.property = Property::kRotation;
  track.target = table;
  track.keys.rotation = true;
  track.keys.width = 4;
  const double per_key = seconds / std::abs(turns) / kKeysPerTurn;
  const auto keys = static_cast<int>(std::ceil(std::max(end, seconds) / per_key)) + 1;
  for (int key = 0; key <= keys; key++) {
    const double half = -std::copysign(std::numbers::pi, turns) * (key % (2 * kKeysPerTurn)) / kKeysPerTurn;
    track.keys.times.push_back(static_cast<float>(key * per_key));
    for (const double value : {0.0, std::sin(half), 0.0, std::cos(half)}) {
      track.keys.values.push_back(static_cast<float>(value));
    }
  }
  animation.playing.push_back(static_cast<int>(animation.clips.size()) - 1);
}

}  // namespace ods
