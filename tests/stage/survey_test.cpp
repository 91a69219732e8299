// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/survey.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"
#include "tests/support/stage_scenes.h"

namespace ods::survey_test {

SceneKind kind_of(const Scene& scene) {
  return survey(SceneRays(scene)).kind;
}

TEST(SceneRays, KnowDistancesInABox) {
  Scene scene = with_materials();
  add(scene, inside_out(make_box(vec3(4, 2, 6))), 0);
  const SceneRays rays(scene);
  EXPECT_NEAR(rays.distance(vec3(0), vec3(1, 0, 0)), 2.0f, 1e-5f);
  EXPECT_NEAR(rays.distance(vec3(0), vec3(0, 0, -1)), 3.0f, 1e-5f);
  EXPECT_NEAR(free_radius(rays, vec3(0)), 1.0f, 0.02f);
  EXPECT_TRUE(is_free(rays, vec3(0), 0.9f));
  EXPECT_FALSE(is_free(rays, vec3(0), 1.1f));
  EXPECT_EQ(floor_below(rays, vec3(1, 0.5f, 1)), -1.0f);
  EXPECT_EQ(openness(rays, vec3(0)).whole, 0.0f);
  EXPECT_EQ(surroundings(rays, vec3(0)).fronts, 1.0f);
  EXPECT_EQ(surroundings(rays, vec3(0)).backs, 0.0f);
  const Bounds seen = seen_bounds(rays, vec3(0));
  EXPECT_NEAR(seen.high.y, 1.0f, 1e-5f);
  EXPECT_NEAR(seen.low.x, -2.0f, 0.1f);
}

TEST(SceneRays, MeetNothingInEmptySpace) {
  Scene scene = with_materials();
  add(scene, make_box(vec3(1)), 0, placed(vec3(10, 0, 0)));
  const SceneRays rays(scene);
  EXPECT_TRUE(rays.look(vec3(0), vec3(0, 1, 0)).leaves());
  EXPECT_FALSE(floor_below(rays, vec3(0)));
  EXPECT_FALSE(rays.look(vec3(10, 0, 0), vec3(0, 1, 0)).front) << "inside a solid, surfaces show their backs";
  EXPECT_GT(openness(rays, vec3(0)).whole, 0.98f);
}

TEST(SceneRays, LightComesThroughGlassAndThroughWhatIsTransparent) {
  Scene scene;
  const int pane = add_material(scene, glass(1.5f));
  Material net = matte(vec3(0.5f));
  net.alpha_mode = kAlphaBlend;
  net.base_color.w = 0.3f;
  const int veil = add_material(scene, net);
  add_rectangle(scene, vec3(-1, -1, -1), vec3(2, 0, 0), vec3(0, 2, 0), pane);
  add_rectangle(scene, vec3(-1, -1, -2), vec3(2, 0, 0), vec3(0, 2, 0), veil);
  const SceneRays rays(scene);
  EXPECT_NEAR(rays.distance(vec3(0), vec3(0, 0, -1)), 1.0f, 1e-5f) << "glass is a surface all the same";
  EXPECT_TRUE(rays.is_open(vec3(0), vec3(0, 0, -1)));
}

TEST(Survey, TellsObjectsFromPlacesAndRooms) {
  EXPECT_EQ(kind_of(Scene()), SceneKind::kNothing);
  EXPECT_EQ(kind_of(make_chair()), SceneKind::kObject);
  EXPECT_EQ(kind_of(make_ball(0.5f)), SceneKind::kObject);
  EXPECT_EQ(kind_of(make_ball(8.0f)), SceneKind::kObject) << "one could stand inside, but it is solid";
  EXPECT_EQ(kind_of(make_car()), SceneKind::kObject);
  EXPECT_EQ(kind_of(resized(make_chair(), 15.0f)), SceneKind::kObject) << "its seat is no floor";
  EXPECT_EQ(kind_of(resized(make_chair(), 100.0f)), SceneKind::kObject) << "in centimetres";
  EXPECT_EQ(kind_of(make_simple_room()), SceneKind::kClosedRoom);
  EXPECT_EQ(kind_of(make_walled_room()), SceneKind::kClosedRoom);
  EXPECT_EQ(kind_of(make_walled_room(true)), SceneKind::kClosedRoom) << "a window does not open it upwards";
  EXPECT_EQ(kind_of(make_cave()), SceneKind::kClosedRoom);
  EXPECT_EQ(kind_of(make_courtyard()), SceneKind::kOpenPlace);
  EXPECT_EQ(kind_of(make_landscape(200.0f)), SceneKind::kOpenPlace);
  EXPECT_EQ(kind_of(make_landscape(100.0f, 0.5f)), SceneKind::kOpenPlace) << "flat";
  EXPECT_EQ(kind_of(make_space()), SceneKind::kOpenPlace);
}

TEST(Survey, AnObjectOnAHugeGroundIsAnObject) {
  Scene scene = with_materials();
  add(scene, make_sphere(0.4f, 64), 0, placed(vec3(0, 0.4f, 0)));
  add(scene, make_floor(100, 100), 1);
  const Survey found = survey(SceneRays(scene));
  EXPECT_EQ(found.kind, SceneKind::kObject);
  EXPECT_LT(found.core.high.x, 1.0f);
  EXPECT_NEAR(found.bounds.high.x, 50.0f, 1e-3f);
}

TEST(Survey, AnObjectInAHallIsSeenInTheHall) {
  Scene scene = with_materials();
  add(scene, make_sphere(0.4f, 200), 1, placed(vec3(0, 0.9f, 0)));
  add(scene, inside_out(make_box(vec3(20, 6, 30))), 0, placed(vec3(0, 3, 0)));
  const Survey found = survey(SceneRays(scene));
  EXPECT_EQ(found.kind, SceneKind::kClosedRoom) << "it needs a lamp, not a studio";
}

TEST(Survey, LeavesOutWhatWasLeftFarAway) {
  Scene scene = make_courtyard();
  const Bounds before = core_bounds(scene);
  add_block(scene, vec3(5000, 0, 0), vec3(5001, 1, 1));
  for (int i = 0; i < 60; i++)
    add(scene, make_sphere(0.2f, 24), 1, placed(vec3(-5.0f + 0.16f * static_cast<float>(i), 0.2f, 2.0f)));
  const Bounds after = core_bounds(scene);
  EXPECT_LT(after.high.x, 100.0f);
  EXPECT_LE(after.high.x, before.high.x);
}

// Hills with a lake in their valley: the water is one sheet, and one could stand on the bed beneath it.
TEST(Survey, NobodyStandsUnderWater) {
  Scene scene = make_landscape(400.0f);
  add(scene, make_floor(400, 400), 1, placed(vec3(0, 12, 0)));
  const Survey found = survey(SceneRays(scene));
  EXPECT_EQ(found.kind, SceneKind::kOpenPlace);
  ASSERT_TRUE(found.stand);
  EXPECT_GT(found.stand->eye.y, 12.0f);
}

// A hollow rock with other rocks in it is not a room: the fronts of those are seen from inside.
TEST(Survey, NobodyStandsInsideOfARock) {
  Scene scene = make_space();
  add(scene, make_sphere(7.0f, 24), 0, placed(vec3(15, 9, 9)));
  for (const float x : {11.0f, 19.0f}) add(scene, make_sphere(1.5f, 16), 1, placed(vec3(x, 9, 9)));
  const Survey found = survey(SceneRays(scene));
  EXPECT_EQ(found.kind, SceneKind::kOpenPlace);
  ASSERT_TRUE(found.stand);
  EXPECT_FALSE(found.stand->floor);
  Scene tower = with_materials();
  add(tower, make_cylinder(9, 3.4f, 32), 0, placed(vec3(0, 1.7f, 0)));
  add(tower, make_cylinder(4, 30, 32), 1, placed(vec3(0, 18.4f, 0)));
  EXPECT_EQ(kind_of(tower), SceneKind::kObject) << "its foot is hollow, as all meshes are";
}

TEST(Survey, ARoomWhoseWallsFaceOutwardsIsARoom) {
  Scene scene = with_materials();
  add(scene, make_box(vec3(6, 2.6f, 5)), 0, placed(vec3(0, 1.3f, 0)));
  add_furniture(scene, vec3(-2.0f, 0, -0.5f));
  add_block(scene, vec3(-2.9f, 0, 1.0f), vec3(-2.4f, 2.0f, 2.2f));
  EXPECT_EQ(kind_of(scene), SceneKind::kClosedRoom);
}

TEST(Survey, HiddenThingsDoNotCount) {
  Scene scene = make_chair();
  scene.hidden.assign(scene.instances.size(), 1);
  EXPECT_EQ(kind_of(scene), SceneKind::kNothing);
}

TEST(Survey, IsTheSameEachTime) {
  const Scene scene = make_courtyard();
  const Survey first = survey(SceneRays(scene)), second = survey(SceneRays(scene));
  EXPECT_EQ(first.stand->eye, second.stand->eye);
  EXPECT_EQ(first.stand->worth, second.stand->worth);
}

}  // namespace ods::survey_test
