// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Builds the tree of boxes that devices without a ray tracer of their own search (ods/kernel/tree.h).
#pragma once
#include <vector>

#include "ods/kernel/tree.h"
#include "ods/scene/scene.h"

namespace ods {

struct SceneTree {
  std::vector<TreeNode> nodes;          // the first is the root
  std::vector<TreeTriangle> triangles;  // of all visible instances, in the world
};

// The number of triangles that a tree has: those of all visible instances.
size_t triangles_in_tree(const Scene& scene);

// Splits where the surface area heuristic is least, on the threads of the calling arena. Source: Wald, "On fast
// Construction of SAH-based Bounding Volume Hierarchies", 2007. Precondition: nothing moves while the shutter is open.
SceneTree make_tree(const Scene& scene);

}  // namespace ods
