// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ods/base/suggest.h"
#include "ods/scene/info.h"

namespace ods {
namespace {

// A unit square in the z = 0 plane, corners (0,0) and (1,1).
Scene make_square() {
  Scene scene;
  Vertex vertex{};
  std::vector<Vertex> vertices;
  for (const vec3 p : {vec3(0, 0, 0), vec3(1, 0, 0), vec3(1, 1, 0), vec3(0, 1, 0)}) {
    vertex.position = p;
    vertices.push_back(vertex);
  }
  scene.materials.push_back(default_material());
  add_mesh(scene, vertices, {{0, 1, 2}, {0, 2, 3}}, 0);
  return scene;
}

glm::mat4 moved(vec3 offset) {
  glm::mat4 matrix(1.0f);
  matrix[3] = vec4(offset, 1.0f);
  return matrix;
}

TEST(SceneInfo, CountsInstancesAndWhatGlows) {
  Scene scene = make_square();
  scene.materials[0].emission = vec3(1.0f);
  add_instance(scene, 0, moved(vec3(0, 0, -5)));
  add_instance(scene, 0, moved(vec3(0, 0, 3)));
  scene.lights.resize(3);
  scene.lights[1].kind = kLightSpot;
  scene.lights[2].kind = kLightDirectional;
  const SceneInfo info = describe(scene, vec3(0.5f, 0.5f, 0.0f));
  EXPECT_EQ(info.meshes, 1u);
  EXPECT_EQ(info.instances, 2u);
  EXPECT_EQ(info.triangles, 2u);
  EXPECT_EQ(info.instanced_triangles, 4u);
  EXPECT_EQ(info.emissive_triangles, 4u);
  EXPECT_EQ(info.point_lights + 10 * info.spot_lights + 100 * info.directional_lights, 111u);
  EXPECT_EQ(info.bounds.low, vec3(0, 0, -5));
  EXPECT_EQ(info.bounds.high, vec3(1, 1, 3));
  EXPECT_FLOAT_EQ(info.nearest_surface, 3.0f);
}

TEST(SceneInfo, NearestSurfaceInEveryRegion) {
  Scene scene = make_square();
  add_instance(scene, 0, moved(vec3(0)));
  EXPECT_FLOAT_EQ(describe(scene, vec3(0.3f, 0.4f, -2)).nearest_surface, 2.0f);  // face
  EXPECT_FLOAT_EQ(describe(scene, vec3(4, 5, 0)).nearest_surface, 5.0f);         // corner
  EXPECT_FLOAT_EQ(describe(scene, vec3(0.5f, -3, 4)).nearest_surface, 5.0f);     // edge
  EXPECT_FLOAT_EQ(describe(Scene(), vec3(0)).nearest_surface, -1.0f);            // nothing
}

TEST(SceneInfo, PointTriangleDistanceAgainstSearch) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  auto point = [&] { return glm::dvec3(number(random), number(random), number(random)); };
  for (int round = 0; round < 200; round++) {
    const glm::dvec3 a = point(), b = point(), c = point(), p = 2.0 * point();
    double nearest = 1e9;
    constexpr int kSteps = 100;
    for (int i = 0; i <= kSteps; i++) {
      for (int j = 0; i + j <= kSteps; j++) {
        const double u = double(i) / kSteps, v = double(j) / kSteps;
        nearest = std::min(nearest, glm::length(p - (a + u * (b - a) + v * (c - a))));
      }
    }
    const double distance = point_triangle_distance(p, a, b, c);
    EXPECT_LE(distance, nearest + 1e-12);
    EXPECT_GE(distance, nearest - 0.03);
  }
}

TEST(SceneInfo, DefaultViewStandsInTheSceneOrBeforeIt) {
  Scene scene = make_square();
  add_instance(scene, 0, moved(vec3(0, 0, 0)));
  EXPECT_EQ(default_view(scene).position, vec3(0.5f, 0.5f, 1.0f));  // flat: one size before it
  add_instance(scene, 0, moved(vec3(20, 9, 20)));
  EXPECT_EQ(default_view(scene).position, vec3(10.5f, 1.6f, 10.0f));  // the origin is a corner of it
  add_instance(scene, 0, moved(vec3(-20, 9, -20)));
  EXPECT_EQ(default_view(scene).position, vec3(0.0f, 1.6f, 0.0f));
  scene.view_points.push_back({"own", vec3(7.0f), 30.0f, 0.0f, 0.0f});
  EXPECT_EQ(default_view(scene).name, "own");
}

TEST(SceneInfo, WhatIsLight) {
  Scene scene = make_square();
  Material& material = scene.materials[0];
  material.emission = vec3(1.0f);
  EXPECT_TRUE(is_emissive(material));
  EXPECT_FALSE(has_light(scene));  // nothing that glows stands in it
  add_instance(scene, 0, moved(vec3(0)));
  EXPECT_TRUE(has_light(scene));
  material.emission_slot.texture = 0;
  EXPECT_FALSE(has_light(scene));
  material.unlit = 1;
  EXPECT_FALSE(is_emissive(material));
  EXPECT_TRUE(has_light(scene));
  EXPECT_EQ(describe(scene, vec3(0.0f)).emissive_triangles, 0u);
  material.unlit = 0;
  scene.environment.radiance = vec3(0.1f);
  EXPECT_TRUE(has_light(scene));
}

TEST(Suggest, OnlyNearWords) {
  EXPECT_EQ(did_you_mean("rom", {"axis", "room"}), "; did you mean 'room'?");
  EXPECT_EQ(did_you_mean("kitchen.glb", {"axis", "room"}), "");
}

}  // namespace
}  // namespace ods
