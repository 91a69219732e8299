// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/upright.h"

#include <gtest/gtest.h>

#include "tests/support/gltf_builder.h"
#include "tests/support/stage_scenes.h"

namespace ods {
namespace {

// A floor with twelve blocks of different heights on it.
Scene make_exhibition() {
  Scene scene = with_materials();
  add_block(scene, vec3(-6, -0.1f, -5), vec3(6, 0, 5), 0);
  for (int i = 0; i < 12; i++) {
    const float x = -5.0f + 0.85f * static_cast<float>(i), z = -4.0f + 0.7f * static_cast<float>(i * 5 % 12);
    add_block(scene, vec3(x, 0, z), vec3(x + 0.4f, 0.5f + 0.13f * static_cast<float>(i * 7 % 12), z + 0.3f));
  }
  return scene;
}

TEST(Upright, WhatStandsAlongZLiesOnItsBack) {
  EXPECT_EQ(why_on_its_back(laid_down(make_exhibition())), "things in the file stand on a floor with z up");
}

// The same with what tools that compress files leave of it: they write their own name.
TEST(Upright, WhatIsFlatOnABoardDoesNotStand) {
  Scene board = with_materials();
  add_block(board, vec3(-6, -5, -0.1f), vec3(6, 5, 0), 0);
  for (int i = 0; i < 12; i++) {
    const float x = -5.0f + 0.85f * static_cast<float>(i), y = -4.0f + 0.7f * static_cast<float>(i * 5 % 12);
    add_block(board, vec3(x, y, 0), vec3(x + 0.8f, y + 0.8f, 0.4f));
  }
  EXPECT_EQ(why_on_its_back(board), "");
}

// The Khronos sample ClearCoatTest: rows of half spheres and their labels on an upright board.
TEST(Upright, ABoardOfBlenderIsUpright) {
  Scene board = laid_down(make_exhibition());
  board.generator = "Khronos glTF Blender I/O v1.2.8 with hand-edits for clearcoat";
  EXPECT_EQ(why_on_its_back(board), "");
  board.generator = "Omnistereo's exporter in Blender 3.4.1";
  EXPECT_NE(why_on_its_back(board), "") << "a file that Blender imported: it has the axes of the file";
}

TEST(Upright, WhatStandsAlongYDoesNot) {
  EXPECT_EQ(why_on_its_back(make_exhibition()), "");
  EXPECT_EQ(why_on_its_back(make_walled_room(true)), "");
  EXPECT_EQ(why_on_its_back(make_courtyard()), "");
  EXPECT_EQ(why_on_its_back(make_chair()), "") << "too few things to tell";
  EXPECT_EQ(why_on_its_back(laid_down(make_chair())), "") << "too few things, too";
  EXPECT_EQ(why_on_its_back(Scene()), "");
}

TEST(Upright, TheReaderTurnsTheFile) {
  GltfBuilder file = make_triangle();
  file.json["nodes"][0]["translation"] = {1, 2, 3};
  file.json["nodes"][0]["camera"] = 0;
  file.json["cameras"] = GltfJson::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
  const Scene scene = file.load({.z_up = true});
  EXPECT_EQ(scene.view_points.at(0).position, vec3(1, 3, -2));
  const Bounds bounds = scene_bounds(scene);
  EXPECT_NEAR(bounds.low.y, 3.0f, 1e-6f);
  EXPECT_NEAR(bounds.low.z, -3.0f, 1e-6f) << "its y axis points away from the viewer";
  EXPECT_NEAR(bounds.high.z, -2.0f, 1e-6f);
}

// A moving node is rotated, too.
TEST(Upright, TheReaderTurnsWhatMoves) {
  GltfBuilder file = make_triangle();
  const int times = file.add<float>({0, 1}, kFloat, "SCALAR");
  const int places = file.add<float>({0, 0, 5, 0, 0, 6}, kFloat, "VEC3");
  file.json["animations"] = {{{"samplers", {{{"input", times}, {"output", places}}}},
                              {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  EXPECT_NEAR(scene_bounds(file.load({.z_up = true})).low.y, 0.0f, 1e-6f) << "at rest, where no clip plays";
  Scene scene = file.load({.z_up = true});
  ASSERT_EQ(scene.animation.nodes.size(), 1u);
  EXPECT_EQ(vec3(scene.animation.nodes[0].before * glm::dvec4(0, 0, 1, 0)), vec3(0, 1, 0));
}

}  // namespace
}  // namespace ods
