// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/outlines.h"

#include <gtest/gtest.h>

#include "ods/stage/unit.h"
#include "tests/support/stage_scenes.h"

namespace ods::outlines_test {

Material culled(vec3 color) {
  Material material = matte(color);
  material.double_sided = 0;
  return material;
}

// A ball on a floor, in a black hull of this radius.
Scene outlined(float radius, bool inwards = true, const Material& material = culled(vec3(0.0f))) {
  Scene scene = with_materials();
  add(scene, make_floor(12, 12), 0);
  add(scene, make_sphere(0.6f, 24), add_material(scene, culled(vec3(0.9f, 0.6f, 0.3f))), placed(vec3(0, 1.6f, -2.5f)));
  const Shape hull = make_sphere(radius, 24);
  add(scene, inwards ? inside_out(hull) : hull, add_material(scene, material), placed(vec3(0, 1.6f, -2.5f)));
  return scene;
}

std::vector<int> roles(Scene scene) {
  mark_outlines(scene);
  std::vector<int> found;
  for (const Instance& instance : scene.instances) found.push_back(instance.role);
  return found;
}

TEST(Outlines, AreInsideOutAndCloseAroundAnObject) {
  const std::vector<int> none = {kOrdinary, kOrdinary, kOrdinary};
  EXPECT_EQ(roles(outlined(0.63f)), (std::vector<int>{kOrdinary, kOrdinary, kOutline}));
  EXPECT_EQ(roles(outlined(0.63f, false)), none) << "a black ball";
  EXPECT_EQ(roles(outlined(0.63f, true, matte(vec3(0.0f)))), none) << "seen from outside, too";
  EXPECT_EQ(roles(outlined(3.0f)), none) << "a room with a ball in it";
}

TEST(Outlines, ARoomWithFurnitureIsNone) {
  Scene room = with_materials();
  add(room, inside_out(make_box(vec3(5, 2.7f, 4))), add_material(room, culled(vec3(0.8f))));
  for (const float x : {-2.4f, -1.4f, -0.4f, 0.6f}) add_block(room, vec3(x, -1.3f, -1.9f), vec3(x + 0.8f, 0.8f, -1.3f));
  EXPECT_EQ(mark_outlines(room), 0u);
}

// The hull hides the ball from rays that measure the scene as little as from the camera.
TEST(Outlines, DoNotMakeARoomOfTheirObject) {
  Scene scene = outlined(0.63f);
  EXPECT_EQ(mark_outlines(scene), 1u);
  const SceneRays rays(scene);
  EXPECT_TRUE(rays.look(vec3(0, 1.6f, 0), vec3(0, 0, -1)).front);
  EXPECT_NEAR(rays.distance(vec3(0, 1.6f, 0), vec3(0, 0, -1)), 1.9f, 0.01f);
  EXPECT_EQ(guess_unit(rays, false).metres, 1.0f);
}

}  // namespace ods::outlines_test
