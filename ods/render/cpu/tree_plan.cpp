// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/cpu/tree_plan.h"

#include "ods/scene/doubled_faces.h"

namespace ods {

static std::vector<char> moving_instances(const Scene& scene) {
  std::vector<char> moves(scene.instances.size());
  if (scene.animation.playing.empty()) return moves;
  for (const MovingInstance& moving : scene.animation.instances) moves[static_cast<size_t>(moving.instance)] = 1;
  return moves;
}

static std::vector<char> choose_shared(const Scene& scene, const std::vector<char>& moves,
                                       size_t max_copied_triangles) {
  std::vector<size_t> uses(scene.meshes.size());
  for (const Instance& instance : scene.instances) uses[static_cast<size_t>(instance.mesh)]++;
  size_t copies = 0;
  for (size_t i = 0; i < uses.size(); i++) copies += uses[i] * scene.meshes[i].triangle_count;
  std::vector<char> shared(scene.meshes.size());
  for (size_t i = 0; i < uses.size(); i++) shared[i] = uses[i] > 1 && copies > max_copied_triangles ? 1 : 0;
  for (size_t i = 0; i < moves.size(); i++) {
    if (moves[i]) shared[static_cast<size_t>(scene.instances[i].mesh)] = 1;
  }
  return shared;
}

TreePlan plan_trees(const Scene& scene, size_t max_copied_triangles) {
  TreePlan plan;
  plan.still_id = static_cast<uint>(scene.instances.size());
  plan.moves = moving_instances(scene);
  plan.shared = choose_shared(scene, plan.moves, max_copied_triangles);
  plan.absent.resize(scene.meshes.size());
  for (const Instance& instance : scene.instances) {
    if (has_absences(instance)) plan.absent[static_cast<size_t>(instance.mesh)] = 1;
  }
  plan.doubled = find_doubled_faces(scene);
  return plan;
}

}  // namespace ods
