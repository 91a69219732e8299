// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/shutter.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace ods {

// Creates rows for everything that may move, in the order of the scene's animation.
static void reserve_rows(Scene& scene) {
  scene.motion_keys = kShutterKeys;
  size_t poses = 0, vertices = 0;
  for (const MovingInstance& moving : scene.animation.instances) {
    if (moving.node == -1) continue;
    scene.instances[static_cast<size_t>(moving.instance)].motion = static_cast<int>(poses);
    poses += kShutterKeys;
  }
  for (const Deformation& deformation : scene.animation.deformations) {
    scene.meshes[static_cast<size_t>(deformation.mesh)].motion = static_cast<int>(vertices);
    vertices += kShutterKeys * deformation.rest.size();
  }
  scene.motion_poses.resize(poses);
  scene.motion_vertices.resize(vertices);
}

static void write_rows(Scene& scene, int key) {
  for (const MovingInstance& moving : scene.animation.instances) {
    const Instance& instance = scene.instances[static_cast<size_t>(moving.instance)];
    if (instance.motion < 0) continue;
    scene.motion_poses[static_cast<size_t>(instance.motion + key)] = {instance.row0, instance.row1, instance.row2};
  }
  for (const Deformation& deformation : scene.animation.deformations) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(deformation.mesh)];
    const Vertex* from = scene.vertices.data() + mesh.first_vertex;
    MotionVertex* to = scene.motion_vertices.data() + mesh.motion + static_cast<size_t>(key) * mesh.vertex_count;
    for (uint i = 0; i < mesh.vertex_count; i++) to[i] = {from[i].position, from[i].normal, vec3(from[i].tangent)};
  }
}

template <class Row>
static bool differ(const std::vector<Row>& a, const std::vector<Row>& b, int first, size_t count) {
  if (a.size() != b.size()) return true;
  const auto at = static_cast<size_t>(first);
  return std::memcmp(a.data() + at, b.data() + at, count * sizeof(Row)) != 0;
}

// Reports objects that move differently than in the previous shutter interval.
static void compare_rows(const Scene& scene, const std::vector<MotionPose>& poses,
                         const std::vector<MotionVertex>& vertices, SceneChange& change) {
  for (const MovingInstance& moving : scene.animation.instances) {
    const int motion = scene.instances[static_cast<size_t>(moving.instance)].motion;
    if (motion >= 0 && differ(scene.motion_poses, poses, motion, kShutterKeys)) {
      change.instances.push_back(moving.instance);
    }
  }
  for (const Deformation& deformation : scene.animation.deformations) {
    const int motion = scene.meshes[static_cast<size_t>(deformation.mesh)].motion;
    if (differ(scene.motion_vertices, vertices, motion, kShutterKeys * deformation.rest.size())) {
      change.meshes.push_back(deformation.mesh);
    }
  }
}

SceneChange open_shutter(Scene& scene, double opens, double closes) {
  assert(opens <= closes);
  if (scene.animation.playing.empty()) return set_time(scene, opens);
  const std::vector<MotionPose> poses = scene.motion_poses;
  const std::vector<MotionVertex> vertices = scene.motion_vertices;
  const std::vector<char> hidden_before = scene.hidden;
  reserve_rows(scene);
  std::vector<char> hidden(scene.instances.size());
  SceneChange change;
  for (int key = 0; key < kShutterKeys; key++) {
    set_time(scene, opens + (closes - opens) * key / (kShutterKeys - 1));
    write_rows(scene, key);
    for (size_t i = 0; i < hidden.size(); i++)
      if (is_hidden(scene, i)) hidden[i] = 1;
  }
  set_time(scene, 0.5 * (opens + closes));
  if (!scene.hidden.empty()) scene.hidden = hidden;
  change.lights = !scene.animation.lights.empty();
  change.materials = !scene.animation.materials.empty();
  change.view_points = !scene.animation.views.empty();
  compare_rows(scene, poses, vertices, change);
  for (size_t i = 0; i < scene.hidden.size(); i++) {
    if (hidden_before.empty() || hidden_before[i] != hidden[i]) change.instances.push_back(static_cast<int>(i));
  }
  return change;
}

}  // namespace ods
