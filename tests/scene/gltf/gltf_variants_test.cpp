// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The choices in a file: material variants and the visibility of nodes.
#include <gtest/gtest.h>

#include "ods/base/error.h"
#include "ods/scene/load/load.h"
#include "ods/scene/motion.h"
#include "tests/support/moving_files.h"
#include "tests/support/scene_check.h"

namespace ods {
namespace {

// --- KHR_materials_variants

// Materials 0, 1 and 2 differ by their roughness: 0.0, 0.1 and 0.2. The mesh has the first by default.
void add_variants(GltfBuilder& file) {
  file.json["extensionsUsed"] = {"KHR_materials_variants"};
  file.json["materials"] = GltfJson::parse(R"([{"pbrMetallicRoughness": {"roughnessFactor": 0.0}},
      {"pbrMetallicRoughness": {"roughnessFactor": 0.1}}, {"pbrMetallicRoughness": {"roughnessFactor": 0.2}}])");
  file.json["extensions"]["KHR_materials_variants"]["variants"] =
      GltfJson::parse(R"([{"name": "red"}, {"name": "green"}, {"name": "blue"}])");
  file.primitive()["material"] = 0;
  file.primitive()["extensions"]["KHR_materials_variants"]["mappings"] =
      GltfJson::parse(R"([{"variants": [2, 1], "material": 2}, {"variants": [1], "material": 1}])");
}

float roughness_of(const Scene& scene, size_t instance) {
  const Mesh& mesh = scene.meshes[size_t(scene.instances[instance].mesh)];
  return scene.materials[size_t(mesh.material)].roughness;
}

TEST(GltfVariants, TheFirstMappingOfAVariantCounts) {
  GltfBuilder file = make_triangle();
  add_variants(file);
  EXPECT_EQ(roughness_of(file.load(), 0), 0.0f);
  EXPECT_EQ(roughness_of(file.load({.variant = "green"}), 0), 0.2f);
  EXPECT_EQ(roughness_of(file.load({.variant = "blue"}), 0), 0.2f);
  EXPECT_EQ(roughness_of(file.load({.variant = "red"}), 0), 0.0f) << "not mapped: the mesh keeps its own material";
  EXPECT_EQ(file.load().variants, (std::vector<std::string>{"red", "green", "blue"}));
  EXPECT_TRUE(file.load().warnings.empty());
}

TEST(GltfVariants, InstancesAndDeformingMeshesFollow) {
  GltfBuilder instanced = make_triangle();
  add_variants(instanced);
  const int where = instanced.add<float>({1, 0, 0, 2, 0, 0}, kFloat, "VEC3");
  instanced.node(0)["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", where}};
  const Scene many = instanced.load({.variant = "blue"});
  ASSERT_EQ(many.instances.size(), 2u);
  for (size_t i = 0; i < 2; i++) EXPECT_EQ(roughness_of(many, i), 0.2f);
  for (GltfBuilder file : {make_skinned(false), make_morphed()}) {
    add_variants(file);
    const Scene scene = file.load({.variant = "blue"});
    EXPECT_EQ(scene.animation.deformations.size(), 1u);
    EXPECT_EQ(roughness_of(scene, 0), 0.2f);
  }
}

std::string refusal(const GltfBuilder& file, const std::string& variant) {
  try {
    file.load({.variant = variant});
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    return error.what();
  }
}

TEST(GltfVariants, AnUnknownNameIsAUsageError) {
  GltfBuilder file = make_triangle();
  EXPECT_EQ(refusal(file, "red"), "`variant`: 'test.glb' has no variant 'red'; it has no variants");
  add_variants(file);
  EXPECT_EQ(refusal(file, "gren"), "`variant`: 'test.glb' has no variant 'gren'; did you mean 'green'?");
  EXPECT_EQ(refusal(file, "purple"), "`variant`: 'test.glb' has no variant 'purple'; it has red, green, blue");
  EXPECT_THROW(load_scene("furnace", {.variant = "red"}), Error);
}

TEST(GltfVariants, AMappingToAMaterialThatDoesNotExistIsDamage) {
  GltfBuilder file = make_triangle();
  add_variants(file);
  file.primitive()["extensions"]["KHR_materials_variants"]["mappings"][0]["material"] = 9;
  EXPECT_EQ(error_of(file.glb()), "") << "not used";
  EXPECT_THROW(file.load({.variant = "blue"}), Error);
}

// --- KHR_node_visibility

const GltfJson kHidden = {{"KHR_node_visibility", {{"visible", false}}}};

// A node with a lamp and a camera, and below it one with the mesh.
GltfBuilder make_family() {
  GltfBuilder file = make_triangle();
  file.json["extensionsUsed"] = {"KHR_node_visibility", "KHR_lights_punctual"};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = GltfJson::parse(R"([{"type": "point"}])");
  file.json["cameras"] = GltfJson::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
  file.json["nodes"] = GltfJson::parse(R"([{"children": [1], "camera": 0}, {"mesh": 0}])");
  file.node(0)["extensions"]["KHR_lights_punctual"]["light"] = 0;
  return file;
}

TEST(GltfVisibility, AHiddenNodeHidesWhatIsBelowIt) {
  GltfBuilder file = make_family();
  file.node(0)["extensions"]["KHR_node_visibility"]["visible"] = true;
  EXPECT_EQ(file.load().instances.size(), 1u);
  file.node(0)["extensions"]["KHR_node_visibility"]["visible"] = false;
  file.node(1)["extensions"]["KHR_node_visibility"]["visible"] = true;
  const Scene scene = file.load();
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_EQ(scene.view_points.size(), 1u) << "cameras stay";
  EXPECT_TRUE(scene.warnings.empty());
}

// A channel that shows and hides a node: bytes, in steps.
void blink(GltfBuilder& file, int node, const std::vector<float>& times, const std::vector<uint8_t>& shown) {
  GltfJson& animation = file.json["animations"][0];
  const size_t index = animation["samplers"].size();
  animation["samplers"].push_back({{"input", file.add<float>(times, kFloat, "SCALAR")},
                                   {"output", file.add<uint8_t>(shown, kUbyte, "SCALAR")},
                                   {"interpolation", "STEP"}});
  animation["channels"].push_back(
      {{"sampler", index},
       {"target", pointer("/nodes/" + std::to_string(node) + "/extensions/KHR_node_visibility/visible")}});
}

Scene at(const GltfBuilder& file, double seconds) {
  Scene scene = file.load();
  EXPECT_TRUE(play(scene.animation, ""));
  set_time(scene, seconds);
  EXPECT_EQ(broken_promise(scene), "") << seconds;
  return scene;
}

TEST(GltfVisibility, AnimationsShowAndHide) {
  GltfBuilder file = make_family();
  file.node(0)["extensions"]["KHR_node_visibility"]["visible"] = false;
  blink(file, 0, {0, 1, 2}, {0, 1, 0});
  const Scene rest = file.load();
  ASSERT_EQ(rest.instances.size(), 1u);
  EXPECT_TRUE(is_hidden(rest, 0));
  EXPECT_EQ(rest.lights.at(0).intensity, vec3(0.0f));
  for (const double t : {0.5, 1.5, 2.5}) {
    const bool shown = t == 1.5;
    const Scene scene = at(file, t);
    EXPECT_EQ(is_hidden(scene, 0), !shown) << t;
    EXPECT_EQ(scene.lights.at(0).intensity, vec3(shown ? 1.0f : 0.0f)) << t;
  }
  Scene scene = at(file, 1.5);
  const SceneChange change = set_time(scene, 2.5);
  EXPECT_EQ(change.instances, std::vector<int>{0});
  EXPECT_TRUE(change.lights);
}

TEST(GltfVisibility, ANodeBelowAnAnimatedOneMayStayHidden) {
  GltfBuilder file = make_family();
  blink(file, 0, {0, 1}, {0, 1});
  file.node(1)["extensions"] = kHidden;
  EXPECT_TRUE(file.load().instances.empty());
}

// A skinned mesh is placed by its joints, and yet shown by its own node.
TEST(GltfVisibility, ASkinnedMeshFollowsItsOwnNode) {
  GltfBuilder file = make_skinned(false);
  blink(file, 0, {0, 1}, {1, 0});
  EXPECT_FALSE(is_hidden(at(file, 0.5), 0));
  EXPECT_TRUE(is_hidden(at(file, 1.5), 0));
  GltfBuilder joints = make_skinned(false);
  blink(joints, 1, {0, 1}, {1, 0});
  EXPECT_FALSE(is_hidden(at(joints, 1.5), 0));
  GltfBuilder morphed = make_morphed();
  blink(morphed, 0, {0, 1}, {1, 0});
  EXPECT_FALSE(is_hidden(at(morphed, 0.5), 0));
  EXPECT_TRUE(is_hidden(at(morphed, 1.5), 0));
}

// A mesh counts once, however many nodes show it.
TEST(GltfVisibility, PointsAndLinesAreCounted) {
  GltfBuilder file = make_triangle();
  file.json["nodes"].push_back({{"mesh", 0}});
  file.json["scenes"][0]["nodes"] = {0, 1};
  auto& primitives = file.json["meshes"][0]["primitives"];
  const auto add = [&](int mode) { primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", mode}}); };
  add(1);
  EXPECT_EQ(file.load().warnings.at(0), "1 line primitive is not rendered: ods renders triangles");
  for (const int mode : {0, 2, 3}) add(mode);
  EXPECT_EQ(file.load().warnings,
            std::vector<std::string>{"3 line and 1 point primitives are not rendered: ods renders triangles"});
}

}  // namespace
}  // namespace ods
