// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Rays through the tree of boxes, compared with Embree's.
#include "ods/render/gpu/tree.h"

#include <gtest/gtest.h>

#include "ods/render/cpu/embree_scene.h"
#include "ods/render/lights.h"
#include "ods/scene/builtin/builtin.h"
#include "tests/support/statistics.h"

namespace ods {
namespace {

// The box around a scene's triangles.
Bounds bounds_of(const SceneTree& tree) {
  const TreeNode& root = tree.nodes.front();
  return {min(root.low_a, root.low_b), max(root.high_a, root.high_b)};
}

struct Traced {
  Scene scene;
  LightTable lights;
  SceneTree tree;
  TreeTracer tracer;

  explicit Traced(const char* name)
      : scene(find_builtin(name)->make()), lights(make_lights(scene)), tree(make_tree(scene)) {
    set_scene(tracer, scene, lights);
    tracer.tree_nodes = tree.nodes.data();
    tracer.tree_triangles = tree.triangles.data();
  }
};

TEST(Tree, RaysMeetWhatTheyMeetInEmbree) {
  for (const char* name : {"furnace", "wineglass", "mirrors"}) {
    Traced traced(name);
    const EmbreeScene embree(traced.scene);
    const Bounds box = bounds_of(traced.tree);
    Dice dice(3);
    int same = 0, hits = 0;
    constexpr int kRays = 20000;
    for (int i = 0; i < kRays; i++) {
      const auto within = [&](int axis) { return dice.between(box.low[axis], box.high[axis]); };
      const vec3 from(within(0), within(1), within(2)), to(within(0), within(1), within(2));
      const Ray ray{from, normalize(to - from)};
      traced.tracer.start_path(ray, no_media(), static_cast<uint>(i), 0u);
      const Hit ours = traced.tracer.nearest_in_tree(ray, kPathRay);
      const Hit theirs = embree.closest_hit(traced.tracer, ray, kPathRay);
      hits += theirs.t >= 0.0f;
      same += ours.t < 0.0f ? theirs.t < 0.0f : std::abs(ours.t - theirs.t) <= 1e-4f * theirs.t + 1e-5f;
      const float length = theirs.t > 0.0f ? 0.5f * theirs.t : 1.0f;
      EXPECT_FALSE(theirs.t > 0.0f && traced.tracer.along_tree(ray, length * 0.999f, kPathRay).blocked) << name;
      if (theirs.t > 0.0f) {
        EXPECT_TRUE(traced.tracer.along_tree(ray, theirs.t * 1.001f + 1e-4f, kPathRay).blocked) << name;
      }
    }
    EXPECT_GT(hits, kRays / 4) << name;
    EXPECT_GE(same, kRays - kRays / 1000) << name;  // grazing rays, and surfaces in one place
  }
}

TEST(Tree, ASceneWithoutTrianglesHasNoHits) {
  const Scene scene;
  const SceneTree tree = make_tree(scene);
  EXPECT_EQ(triangles_in_tree(scene), 0u);
  TreeTracer tracer;
  tracer.tree_nodes = tree.nodes.data();
  tracer.tree_triangles = tree.triangles.data();
  EXPECT_LT(tracer.nearest_in_tree({vec3(1.0f), vec3(0.0f, 0.0f, -1.0f)}, kPathRay).t, 0.0f);
}

}  // namespace
}  // namespace ods
