// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Decides how the objects of a scene are arranged in Embree's trees, and which of their surfaces rays may not meet.
#pragma once
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

struct TreePlan {
  uint still_id = 0;                       // number of the tree of all static instances, if something moves
  std::vector<char> moves;                 // by instance
  std::vector<char> shared;                // by mesh: instanced, because it moves or would need too many copies
  std::vector<char> absent;                // by mesh: some rays do not meet an instance of it
  std::vector<std::vector<char>> doubled;  // find_doubled_faces()

  bool is_doubled(size_t mesh) const { return !doubled[mesh].empty(); }
};

// max_copied_triangles: as in EmbreeScene.
TreePlan plan_trees(const Scene& scene, size_t max_copied_triangles);

}  // namespace ods
