// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The losses of Blender's export: the nodes and materials here are as Blender 3.4 writes them.
// tests/peers/blender_export_test.cpp has Blender write them.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/gltf_builder.h"

namespace ods {
namespace {

GltfBuilder make_export() {
  GltfBuilder file = make_triangle();
  file.json["asset"]["generator"] = "Khronos glTF Blender I/O v3.4.50";
  return file;
}

bool says(const Scene& scene, const std::string& part) {
  return std::ranges::any_of(scene.losses, [&](const auto& loss) { return loss.find(part) != std::string::npos; });
}

// With the boxes ticked: a panoramic camera, moving, and an area light come as empty nodes.
GltfBuilder make_lit_export() {
  GltfBuilder file = make_export();
  file.json["extensionsUsed"] = {"KHR_lights_punctual"};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] =
      GltfJson::parse(R"([{"color": [1, 1, 1], "intensity": 543.5, "type": "point", "name": "bulb"}])");
  file.json["nodes"].push_back(
      GltfJson::parse(R"({"name": "bulb", "extensions": {"KHR_lights_punctual": {"light": 0}}})"));
  file.json["nodes"].push_back(
      GltfJson::parse(R"({"name": "ceiling area", "rotation": [-0.7071068, 0, 0, 0.7071068]})"));
  file.json["nodes"].push_back(GltfJson::parse(R"({"name": "Eye", "translation": [1, 1.6, 2]})"));
  file.json["nodes"].push_back(GltfJson::parse(R"({"name": "Empty"})"));
  file.json["scenes"][0]["nodes"] = {0, 1, 2, 3, 4};
  const int times = file.add<float>({0, 1}, kFloat, "SCALAR");
  const int places = file.add<float>({1, 1.6f, 2, 1, 1.6f, 3}, kFloat, "VEC3");
  file.json["animations"] = {{{"samplers", {{{"input", times}, {"output", places}}}},
                              {"channels", {{{"sampler", 0}, {"target", {{"node", 3}, {"path", "translation"}}}}}}}};
  return file;
}

TEST(GltfLosses, LightsAndCamerasWithoutTheirBoxes) {
  const Scene scene = make_export().load();
  EXPECT_EQ(scene.generator, "Khronos glTF Blender I/O v3.4.50");
  ASSERT_EQ(scene.losses.size(), 1u);
  EXPECT_TRUE(says(scene, "Punctual Lights"));
}

TEST(GltfLosses, EmptyNodesThatWereCamerasAndAreaLights) {
  const Scene scene = make_lit_export().load();
  ASSERT_EQ(scene.losses.size(), 2u);
  EXPECT_TRUE(says(scene, "`camera` 'Eye'")) << scene.losses[0];
  EXPECT_TRUE(says(scene, "area lights: 'ceiling area' may")) << scene.losses[1];
  EXPECT_FALSE(says(scene, "Empty"));
  EXPECT_TRUE(scene.view_points.empty());
}

TEST(GltfLosses, ANodeStandsInForTheCameraThatItWas) {
  const Scene scene = make_lit_export().load({.camera = "Eye"});
  ASSERT_EQ(scene.view_points.size(), 1u);
  EXPECT_EQ(scene.view_points[0].name, "Eye");
  EXPECT_EQ(scene.view_points[0].position, vec3(1, 1.6f, 2));
  EXPECT_EQ(scene.animation.views.size(), 1u) << "it moves";
  EXPECT_FALSE(says(scene, "panoramic"));
  EXPECT_TRUE(make_lit_export().load({.camera = "nobody"}).view_points.empty());
}

// A camera of that name is the one that is meant.
TEST(GltfLosses, ACameraWinsOverANodeOfItsName) {
  GltfBuilder file = make_lit_export();
  file.json["cameras"] = GltfJson::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
  file.json["nodes"].push_back(GltfJson::parse(R"({"name": "Eye", "camera": 0, "translation": [7, 0, 0]})"));
  file.json["scenes"][0]["nodes"].push_back(5);
  const Scene scene = file.load({.camera = "Eye"});
  ASSERT_EQ(scene.view_points.size(), 1u);
  EXPECT_EQ(scene.view_points[0].position, vec3(7, 0, 0));
}

TEST(GltfLosses, MaterialsWithoutValues) {
  GltfBuilder file = make_export();
  file.json["materials"] = GltfJson::parse(R"([
      {"doubleSided": true, "name": "procedural plaster", "pbrMetallicRoughness": {"metallicFactor": 0}},
      {"doubleSided": true, "name": "glass bsdf", "pbrMetallicRoughness": {}},
      {"name": "wall", "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.78, 0.74, 1]}},
      {"name": "glass", "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}},
      {"name": "lamp", "emissiveFactor": [1, 1, 1]}])");
  const Scene scene = file.load();
  EXPECT_TRUE(says(scene, "'procedural plaster', 'glass bsdf'"));
  EXPECT_FALSE(says(scene, "wall"));
}

TEST(GltfLosses, OtherProgramsAreNotBlamed) {
  GltfBuilder file = make_lit_export();
  file.json["asset"]["generator"] = "three.js";
  EXPECT_TRUE(file.load().losses.empty());
}

}  // namespace
}  // namespace ods
