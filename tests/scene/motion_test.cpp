// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes at a time, from glTF files made here, against positions worked out in double precision.
#include "ods/scene/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/support/moving_files.h"
#include "tests/support/scene_check.h"

namespace ods {
namespace {

using glm::dvec3, glm::dvec4, glm::dmat4;

// Plays everything of the file at a time.
Scene at(const Scene& loaded, double seconds) {
  Scene scene = loaded;
  EXPECT_TRUE(play(scene.animation, ""));
  set_time(scene, seconds);
  EXPECT_EQ(broken_promise(scene), "") << seconds;
  return scene;
}

dvec3 in_world(const Instance& i, vec3 p) {
  const dvec4 q(dvec3(p), 1.0);
  return {dot(dvec4(i.row0), q), dot(dvec4(i.row1), q), dot(dvec4(i.row2), q)};
}

void expect_near(dvec3 actual, dvec3 expected, double tolerance = 1e-6) {
  for (int i = 0; i < 3; i++) EXPECT_NEAR(actual[i], expected[i], tolerance) << "component " << i;
}

TEST(Motion, ANodeCarriesItsChildren) {
  GltfBuilder file = make_triangle();
  file.json["nodes"] = GltfJson::parse(R"([{"children": [1], "translation": [0, 5, 0]},
                                       {"mesh": 0, "translation": [2, 0, 0]}])");
  const float s = std::sqrt(0.5f);
  animate(file, node_target(0, "rotation"), {0, 1}, {0, 0, 0, 1, 0, s, 0, s}, "VEC4");
  const Scene rest = file.load();
  EXPECT_EQ(rest.animation.clips.size(), 1u);
  EXPECT_EQ(length_of(rest.animation), 0.0) << "nothing plays before somebody says so";
  expect_near(in_world(rest.instances[0], vec3(1, 0, 0)), {3, 5, 0});
  for (const double t : {0.0, 0.25, 0.5, 1.0, 7.0}) {
    const Scene scene = at(rest, t);
    const double angle = std::min(t, 1.0) * std::acos(0.0);
    expect_near(in_world(scene.instances[0], vec3(1, 0, 0)), {3 * std::cos(angle), 5, -3 * std::sin(angle)});
  }
}

TEST(Motion, ASkinBlendsItsJoints) {
  for (const bool second_set : {false, true}) {
    const Scene rest = make_skinned(second_set).load();
    expect_near(in_world(rest.instances[0], rest.vertices[1].position), {1, 0.5, 0});
    for (const double t : {0.0, 0.5, 1.0, 1.7}) {
      const Scene scene = at(rest, t);
      const double angle = 0.5 * t * std::acos(0.0), c = std::cos(angle), s = std::sin(angle);
      const auto turned = [&](dvec3 p) { return dvec3(1 + c * (p.x - 1) - s * p.y, s * (p.x - 1) + c * p.y, p.z); };
      const dvec3 known[] = {{0, 0, 0}, 0.25 * dvec3(1, 0.5, 0) + 0.75 * turned({1, 0.5, 0}), turned({2, 0, 0})};
      for (size_t i = 0; i < 3; i++) expect_near(in_world(scene.instances[0], scene.vertices[i].position), known[i]);
      expect_near(dvec3(scene.vertices[2].normal), {-s, c, 0});
    }
  }
}

TEST(Motion, MorphTargetsAddUp) {
  const Scene rest = make_morphed().load();
  expect_near(dvec3(rest.vertices[1].position), {1, 0.5, 0});
  for (const double t : {0.0, 0.5, 1.0}) {
    const Scene scene = at(rest, t);
    expect_near(dvec3(scene.vertices[0].position), {0, 2 * t, 0});
    expect_near(dvec3(scene.vertices[2].position), {0, 1 + 2 * t + 4 * t, 0});
    expect_near(dvec3(scene.vertices[0].normal), dvec3(2 * t, 0, 1) / std::sqrt(1 + 4 * t * t));
  }
}

TEST(Motion, AMeshWithoutNormalsStaysFlat) {
  GltfBuilder file = make_triangle();
  file.primitive()["targets"] = {{{"POSITION", file.add<float>({0, 0, 0, 0, 0, -1, 0, 0, 0}, kFloat, "VEC3")}}};
  animate(file, node_target(0, "weights"), {0, 1}, {0, 1}, "SCALAR");
  const Scene scene = at(file.load(), 1.0);
  for (const Vertex& vertex : scene.vertices) expect_near(dvec3(vertex.normal), dvec3(1, 0, 1) / std::sqrt(2.0));
}

// Two nodes with one mesh: each has weights of its own.
TEST(Motion, NodesBendTheirOwnCopies) {
  GltfBuilder file = make_morphed();
  file.json["nodes"].push_back({{"mesh", 0}, {"weights", {1.0, 0.0}}});
  file.json["scenes"][0]["nodes"] = {0, 1};
  const Scene scene = at(file.load(), 0.0);
  ASSERT_EQ(scene.instances.size(), 2u);
  const auto first_corner = [&](size_t i) {
    return scene.vertices[scene.meshes[size_t(scene.instances[i].mesh)].first_vertex].position;
  };
  EXPECT_EQ(first_corner(0), vec3(0, 0, 0));
  EXPECT_EQ(first_corner(1), vec3(0, 1, 0));
}

TEST(Motion, TheTimeAloneDecides) {
  for (const GltfBuilder& file : {make_skinned(false), make_morphed()}) {
    const Scene alone = at(file.load(), 0.6);
    Scene run = file.load();
    play(run.animation, "");
    for (const double t : {0.0, 2.0, 0.3, 0.6}) set_time(run, t);
    EXPECT_EQ(std::memcmp(alone.vertices.data(), run.vertices.data(), run.vertices.size() * sizeof(Vertex)), 0);
    const SceneChange change = set_time(run, 0.6);
    EXPECT_TRUE(change.instances.empty() && change.meshes.empty()) << "nothing has moved since";
  }
}

TEST(Motion, WhatIsScaledToNothingIsHidden) {
  GltfBuilder file = make_triangle();
  animate(file, node_target(0, "scale"), {0, 1, 2}, {0, 0, 0, 1, 1, 1, 1, 1, 0}, "VEC3");
  const Scene rest = file.load();
  EXPECT_FALSE(is_hidden(rest, 0));
  EXPECT_TRUE(is_hidden(at(rest, 0.0), 0));
  EXPECT_FALSE(is_hidden(at(rest, 0.5), 0));
  EXPECT_TRUE(is_hidden(at(rest, 2.0), 0));
}

TEST(Motion, WhatFliesTooFarIsHidden) {
  GltfBuilder file = make_triangle();
  animate(file, node_target(0, "translation"), {0, 1}, {0, 0, 0, 3e38f, 0, 0}, "VEC3");
  EXPECT_FALSE(is_hidden(at(file.load(), 0.0), 0));
  EXPECT_TRUE(is_hidden(at(file.load(), 0.5), 0));
  GltfBuilder morphed = make_morphed();
  animate(morphed, node_target(0, "weights"), {0, 1}, {0, 0, 3e38f, 0}, "SCALAR");
  EXPECT_TRUE(is_hidden(at(morphed.load(), 1.0), 0));
}

TEST(Motion, CamerasAndLightsRideOnNodes) {
  GltfBuilder file = make_triangle();
  file.json["cameras"] = GltfJson::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
  file.json["extensions"]["KHR_lights_punctual"]["lights"] =
      GltfJson::parse(R"([{"type": "spot", "intensity": 10, "spot": {}}])");
  file.json["nodes"].push_back(GltfJson::parse(R"({"camera": 0})"));
  file.json["nodes"].push_back(GltfJson::parse(R"({"extensions": {"KHR_lights_punctual": {"light": 0}}})"));
  file.json["scenes"][0]["nodes"] = {0, 1, 2};
  animate(file, node_target(1, "translation"), {0, 1}, {0, 1, 0, 0, 2, -4}, "VEC3");
  const float s = std::sqrt(0.5f);
  animate(file, node_target(1, "rotation"), {0, 1}, {0, 0, 0, 1, 0, -s, 0, s}, "VEC4");
  animate(file, node_target(2, "translation"), {0, 1}, {0, 1, 0, 0, 3, 0}, "VEC3", "STEP");
  animate(file, pointer("/extensions/KHR_lights_punctual/lights/0/intensity"), {0, 1}, {10, 30}, "SCALAR");
  animate(file, pointer("/extensions/KHR_lights_punctual/lights/0/color"), {0, 1}, {1, 1, 1, 1, 0, 0}, "VEC3");
  animate(file, pointer("/extensions/KHR_lights_punctual/lights/0/range"), {0, 1}, {5, 7}, "SCALAR");
  animate(file, pointer("/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle"), {0, 1}, {0.5f, 1}, "SCALAR");
  animate(file, pointer("/extensions/KHR_lights_punctual/lights/0/spot/innerConeAngle"), {0, 1}, {0, 0.5f}, "SCALAR");
  const Scene scene = at(file.load(), 0.5);
  expect_near(dvec3(scene.view_points[0].position), {0, 1.5, -2});
  EXPECT_NEAR(scene.view_points[0].yaw, 45.0f, 1e-4f);
  const PunctualLight& light = scene.lights[0];
  expect_near(dvec3(light.position), {0, 1, 0});
  expect_near(dvec3(light.intensity), {20, 10, 10});
  EXPECT_FLOAT_EQ(light.range, 6.0f);
  EXPECT_FLOAT_EQ(light.outer_cone, 0.75f);
  EXPECT_FLOAT_EQ(light.inner_cone, 0.25f);
  const Scene end = at(file.load(), 1.0);
  EXPECT_NEAR(end.view_points[0].yaw, 90.0f, 1e-4f);
  expect_near(dvec3(end.lights[0].position), {0, 3, 0});
}

// Returns whether the first view point moves; the camera is a child of node 1.
bool moves_camera(const GltfJson& target, const std::vector<float>& values, const std::string& type) {
  GltfBuilder file = make_triangle();
  file.json["cameras"] = GltfJson::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
  file.json["nodes"].push_back(GltfJson::parse(R"({"children": [2]})"));
  file.json["nodes"].push_back(GltfJson::parse(R"({"camera": 0})"));
  file.json["scenes"][0]["nodes"] = {0, 1};
  animate(file, node_target(1, "scale"), {0, 1}, {1, 1, 1, 1, 1, 1}, "VEC3");  // stands still
  animate(file, target, {0, 1}, values, type);
  Scene scene = file.load();
  EXPECT_FALSE(moves_view(scene.animation, 0)) << "at rest";
  play(scene.animation, "");
  return moves_view(scene.animation, 0);
}

TEST(Motion, ACameraMovesWithWhatItIsFixedTo) {
  const float s = std::sqrt(0.5f);
  EXPECT_TRUE(moves_camera(node_target(2, "translation"), {0, 1, 0, 0, 2, 0}, "VEC3"));
  EXPECT_TRUE(moves_camera(node_target(1, "translation"), {0, 1, 0, 0, 2, 0}, "VEC3"));
  EXPECT_TRUE(moves_camera(node_target(1, "rotation"), {0, 0, 0, 1, 0, -s, 0, s}, "VEC4"));
  EXPECT_FALSE(moves_camera(node_target(2, "translation"), {0, 1, 0, 0, 1, 0}, "VEC3"));
  EXPECT_FALSE(moves_camera(node_target(0, "translation"), {0, 1, 0, 0, 2, 0}, "VEC3"));
}

TEST(Motion, MaterialsChange) {
  GltfBuilder file = make_triangle();
  file.primitive()["material"] = 0;
  file.json["materials"] = GltfJson::parse(R"([{"emissiveFactor": [0.5, 0.5, 0], "pbrMetallicRoughness":
      {"roughnessFactor": 0.25}, "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}}}])");
  const std::string m = "/materials/0";
  animate(file, pointer(m + "/extensions/KHR_materials_emissive_strength/emissiveStrength"), {0, 1}, {4, 8}, "SCALAR");
  animate(file, pointer(m + "/pbrMetallicRoughness/baseColorFactor"), {0, 1}, {1, 1, 1, 1, 0, 2, 0, 0.5f}, "VEC4");
  animate(file, pointer(m + "/pbrMetallicRoughness/metallicFactor"), {0, 1}, {1, 0}, "SCALAR");
  animate(file, pointer(m + "/emissiveTexture/extensions/KHR_texture_transform/offset"), {0, 1}, {0, 0, 1, 2}, "VEC2");
  animate(file, pointer(m + "/normalTexture/extensions/KHR_texture_transform/rotation"), {0, 1}, {0, 1}, "SCALAR");
  const Material material = at(file.load(), 0.5).materials[0];
  expect_near(dvec3(material.emission), {3, 3, 0});
  expect_near(dvec3(material.base_color), {0.5, 1, 0.5});
  EXPECT_FLOAT_EQ(material.metallic, 0.5f);
  EXPECT_FLOAT_EQ(material.roughness, 0.25f);
  EXPECT_FLOAT_EQ(material.emission_slot.offset.y, 1.0f);
  EXPECT_NEAR(material.normal_slot.axis_u.y, -std::sin(0.5), 1e-6);
  EXPECT_EQ(at(file.load(), 1.0).materials[0].base_color, vec4(0, 1, 0, 0.5f)) << "kept to what is legal";
}

TEST(Motion, TakesOfOneFigureDoNotMix) {
  GltfBuilder file = make_triangle();
  file.json["nodes"].push_back({{"mesh", 0}});
  file.json["scenes"][0]["nodes"] = {0, 1};
  animate(file, node_target(0, "translation"), {0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3");
  file.json["animations"].push_back(file.json["animations"][0]);
  file.json["animations"].push_back(file.json["animations"][0]);
  file.json["animations"][1]["name"] = "other take";
  file.json["animations"][2]["channels"][0]["target"]["node"] = 1;
  Scene scene = file.load();
  EXPECT_TRUE(play(scene.animation, ""));
  EXPECT_EQ(scene.animation.playing, (std::vector<int>{0, 2}));
  EXPECT_EQ(length_of(scene.animation), 1.0);
  EXPECT_TRUE(play(scene.animation, "other take"));
  EXPECT_EQ(scene.animation.playing, std::vector<int>{1});
  EXPECT_FALSE(play(scene.animation, "third"));
}

}  // namespace
}  // namespace ods
