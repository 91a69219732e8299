// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/placement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/gltf_builder.h"

namespace ods::placement_test {

Bounds box(vec3 middle, float half) {
  return {middle - half, middle + half};
}

TEST(Placement, ASmallSceneFarAwayHasAMiddle) {
  EXPECT_EQ(far_middle(box(vec3(42000.4f, 30, -7), 3.0f)), vec3(42000, 30, -7));
  EXPECT_EQ(far_middle(box(vec3(1000, 0, 0), 3.0f)), vec3(0.0f)) << "near enough";
  EXPECT_EQ(far_middle(box(vec3(5000, 0, 0), 5000.0f)), vec3(0.0f)) << "a room in millimetres, or a landscape";
}

// The triangle of make_triangle(), a lamp and a camera below a root far away.
GltfBuilder far_triangle(std::vector<double> translation) {
  GltfBuilder file = make_triangle();
  file.json["extensionsUsed"] = {"KHR_lights_punctual"};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  file.json["cameras"] = GltfJson::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
  file.json["nodes"].push_back({{"camera", 0}, {"translation", {0.25, 0.5, 2}}});
  file.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"translation", {0, 1, 0}}});
  file.json["nodes"].push_back({{"children", {0, 1, 2}}, {"translation", translation}});
  file.json["scenes"][0]["nodes"] = {3};
  return file;
}

TEST(Placement, MapCoordinatesAreKeptInDouble) {
  const Scene scene = far_triangle({12958095.1, 30.0, -4865499.4}).load();
  EXPECT_LT(glm::length(scene.origin - glm::dvec3(12958095.6, 30.5, -4865499.4)), 2.0) << "its middle, roughly";
  EXPECT_EQ(scene.origin, glm::round(scene.origin)) << "in whole metres";
  const Instance& instance = scene.instances.at(0);
  EXPECT_NEAR(instance.row0.w, 12958095.1 - scene.origin.x, 1e-6);
  EXPECT_NEAR(instance.row2.w, -4865499.4 - scene.origin.z, 1e-6);
  EXPECT_NEAR(scene.view_points.at(0).position.x, instance.row0.w + 0.25f, 1e-6);
  EXPECT_NEAR(scene.lights.at(0).position.y, instance.row1.w + 1.0f, 1e-6);
  for (const std::string& warning : scene.warnings) EXPECT_EQ(warning.find("from the origin"), std::string::npos);
}

TEST(Placement, NearScenesKeepTheirPlace) {
  const Scene scene = far_triangle({1200, 30, -700}).load();
  EXPECT_EQ(scene.origin, glm::dvec3(0.0));
  EXPECT_EQ(scene.instances.at(0).row0.w, 1200.0f);
  const Scene kept = far_triangle({42000, 0, 0}).load({.finds_origin = false});
  EXPECT_EQ(kept.instances.at(0).row0.w, 42000.0f);
}

// A mesh whose own points are far away, which a node moves back.
TEST(Placement, PointsFarAwayAreMovedWithTheirNode) {
  GltfBuilder file = make_triangle();
  const std::vector<float> points = {42000, 0, 0, 42001, 0, 0, 42000, 1, 0};
  file.primitive()["attributes"]["POSITION"] = file.add(points, kFloat, "VEC3");
  file.node(0)["rotation"] = {0, 0.6, 0, 0.8};
  const Scene scene = file.load();
  EXPECT_NE(scene.origin, glm::dvec3(0.0));
  const Mesh& mesh = scene.meshes.at(0);
  EXPECT_LT(std::abs(scene.vertices[mesh.first_vertex].position.x), 2.0f);
  const Bounds bounds = scene_bounds(scene);
  EXPECT_LT(length(bounds.high), 2.0f);
  EXPECT_NEAR(length(bounds.high - bounds.low), length(vec3(0.28f, 1.0f, 0.96f)), 1e-4f);
}

}  // namespace ods::placement_test
