// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/holes.h"

#include <gtest/gtest.h>

#include <utility>

#include "ods/base/error.h"
#include "ods/layers/build_layers.h"
#include "tests/support/scenes.h"

namespace ods::holes_test {

// A closed box of 2 m around the origin.
Scene room() {
  Scene scene;
  add_box(scene, vec3(-1.0f), vec3(1.0f), add_material(scene, matte(vec3(0.5f))));
  return scene;
}

// The room's walls as layers; of the wall ahead only the part to the left of x, whose front is inside if x > -1.
LayeredScene walls_up_to(float x) {
  LayeredScene layers;
  LayerMesh mesh;
  const auto add = [&](vec3 a, vec3 b, vec3 c, vec3 d) {
    const uint first = static_cast<uint>(mesh.positions.size());
    for (const vec3& corner : {a, b, c, d}) mesh.positions.push_back(corner), mesh.uvs.emplace_back(0.0f);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
  };
  add({-1, -1, -1}, {x, -1, -1}, {x, 1, -1}, {-1, 1, -1});  // ahead
  add({1, -1, 1}, {-1, -1, 1}, {-1, 1, 1}, {1, 1, 1});      // behind
  add({1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1});      // right
  add({-1, -1, 1}, {-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1});  // left
  add({-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1});      // above
  add({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1});  // below
  layers.meshes = {mesh};
  return layers;
}

TEST(Holes, NoneInACompleteRoom) {
  const Scene scene = room();
  const FirstHits hits(scene);
  const LayerHoles holes = find_holes(hits, walls_up_to(1.0f));
  EXPECT_EQ(holes.share, 0.0);
  EXPECT_EQ(holes.worst, 0.0);
}

// Half of one of six walls is missing; the eyes are at the middle on average.
TEST(Holes, AreTheShareOfMissingWalls) {
  const Scene scene = room();
  const FirstHits hits(scene);
  LayeredScene layers = walls_up_to(0.0f);
  layers.box.size = vec3(1e-4f);
  EXPECT_NEAR(find_holes(hits, layers).share, 1.0 / 12.0, 0.003);
  layers.box.size = vec3(0.3f);
  const LayerHoles holes = find_holes(hits, layers);
  EXPECT_NEAR(holes.share, 1.0 / 12.0, 0.01);
  EXPECT_GT(holes.worst, holes.share + 0.005);
}

// The back of a layer does not hide a hole behind it, and is passed where there is a front behind it.
TEST(Holes, ABackIsInvisible) {
  const Scene scene = room();
  const FirstHits hits(scene);
  LayeredScene layers = walls_up_to(0.0f);
  layers.box.size = vec3(1e-4f);
  LayeredScene turned = layers;
  LayerMesh screen = layers.meshes[0];
  for (vec3& position : screen.positions) position *= 0.5f;
  for (uvec3& triangle : screen.triangles) std::swap(triangle.x, triangle.y);
  turned.meshes.push_back(screen);
  EXPECT_EQ(find_holes(hits, turned).share, find_holes(hits, layers).share);
}

// Neither the sky nor a pane in front of a missing wall makes it less of a hole.
TEST(Holes, TheSkyAndPanesHideNothing) {
  const Scene scene = room();
  const FirstHits hits(scene);
  LayeredScene layers = walls_up_to(0.0f);
  const double before = find_holes(hits, layers).share;
  for (const LayerKind kind : {LayerKind::kSky, LayerKind::kBlended}) {
    layers.meshes.push_back(walls_up_to(1.0f).meshes[0]);
    layers.meshes.back().kind = kind;
    EXPECT_EQ(find_holes(hits, layers).share, before);
  }
}

TEST(Holes, OfARoomThatWasBuiltAreFew) {
  const Scene scene = room();
  LayerCounts counts;
  build_layers(scene, {}, 512, &counts);
  EXPECT_LT(counts.holes.worst, 1e-4);
}

TEST(Holes, CanBeCancelled) {
  const Scene scene = room();
  EXPECT_THROW(find_holes(FirstHits(scene), walls_up_to(1.0f), {{}, [] { return true; }}), Error);
}

}  // namespace ods::holes_test
