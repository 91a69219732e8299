// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/repeats.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ods/stage/scene_rays.h"
#include "tests/support/gltf_builder.h"

namespace ods {
namespace {

// The maximum number of instances that a ray is tested against.
ptrdiff_t met_instances(const Scene& scene) {
  const SceneRays rays(scene);
  ptrdiff_t count = 0;
  for (size_t i = 0; i < scene.instances.size(); i++) count += rays.meets(i) ? 1 : 0;
  return count;
}

constexpr size_t kMany = 300;

// A mesh that lists its primitive many times, each time of the next of these materials.
GltfBuilder make_many(const GltfJson& materials) {
  GltfBuilder gltf = make_triangle();
  gltf.json["materials"] = materials;
  const GltfJson first = gltf.primitive();
  GltfJson& list = gltf.json["meshes"][0]["primitives"];
  list = GltfJson::array();
  for (size_t i = 0; i < kMany; i++) {
    list.push_back(first);
    list.back()["material"] = i % materials.size();
  }
  return gltf;
}

TEST(Repeats, RaysMeetOnePrimitiveOfManyThatShareTheirAccessors) {
  const Scene scene = make_many(GltfJson::array({GltfJson::object(), GltfJson::object()})).load();
  ASSERT_EQ(scene.instances.size(), kMany);
  EXPECT_EQ(met_instances(scene), 1);
  EXPECT_FALSE(SceneRays(scene).look(vec3(0.2f, 0.2f, 1.0f), vec3(0.0f, 0.0f, -1.0f)).leaves());
}

TEST(Repeats, RaysMeetOneNodeOfManyAtOnePlace) {
  GltfBuilder gltf = make_triangle();
  for (size_t i = 1; i < kMany; i++) {
    gltf.json["nodes"].push_back({{"mesh", 0}});
    gltf.json["scenes"][0]["nodes"].push_back(i);
  }
  gltf.node(7)["translation"] = {0, 0, 1};
  EXPECT_EQ(met_instances(gltf.load()), 2);
}

TEST(Repeats, WhatRaysPassCountsByItsMaterial) {
  const GltfJson blend = {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.2}}}}};
  const Scene scene = make_many(GltfJson::array({blend, GltfJson::object()})).load();
  EXPECT_EQ(met_instances(scene), 2);
  EXPECT_FALSE(SceneRays(scene).look(vec3(0.2f, 0.2f, 1.0f), vec3(0.0f, 0.0f, -1.0f)).leaves());
}

TEST(Repeats, WhatIsLeftOutIsNotInTheTree) {
  const Scene scene = make_triangle().load();
  const EmbreeScene embree(scene, EmbreeScene::kMaxCopiedTriangles, {1});
  PathTracer tracer;
  EXPECT_LT(embree.closest_hit(tracer, {vec3(0.2f, 0.2f, 1.0f), vec3(0.0f, 0.0f, -1.0f)}, kHalfAlphaRay).t, 0.0f);
}

}  // namespace
}  // namespace ods
