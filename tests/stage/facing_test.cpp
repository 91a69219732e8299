// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/facing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "ods/stage/place.h"
#include "tests/support/kinds_of_scene.h"
#include "tests/support/stage_scenes.h"

namespace ods {
namespace {

// The view point that settle() chooses in a kind of scene.
ViewPoint viewer_of(std::string_view name) {
  for (const KindOfScene& kind : kinds_of_scene()) {
    if (name != kind.name) continue;
    Scene scene = kind.make();
    settle(scene);
    return scene.viewing.value().view;
  }
  ADD_FAILURE() << name;
  return {};
}

// The angle by which the view has to turn to face a point, degrees.
float off_middle(const ViewPoint& view, vec3 point) {
  const vec3 way = point - view.position;
  return std::abs(std::remainder(glm::degrees(std::atan2(way.x, -way.z)) - view.yaw, 360.0f));
}

TEST(Facing, ALivingRoomIsSeenWithItsSofaWhole) {
  for (const char* name : {"room-with-lamps", "room-without-a-lamp", "tiny-room"}) {
    const ViewPoint view = viewer_of(name);
    for (const float end : {-1.0f, 1.0f}) EXPECT_LT(off_middle(view, {end, 0.5f, -1.7f}), 40.0f) << name;
  }
}

TEST(Facing, AGalleryIsSeenByItsPicturesAndNotByItsColumns) {
  const ViewPoint view = viewer_of("huge-room");
  for (const float side : {-2.2f, 2.2f}) EXPECT_GT(off_middle(view, {side, 1.6f, 0.0f}), 40.0f);
  EXPECT_LT(std::min(off_middle(view, {0, 1.6f, 3.5f}), off_middle(view, {0, 1.6f, -3.5f})), 25.0f);
}

TEST(Facing, AStreetIsSeenAlongItsLength) {
  const ViewPoint view = viewer_of("neon-street");
  EXPECT_LT(std::min(off_middle(view, {0, 1.6f, 16}), off_middle(view, {0, 1.6f, -16})), 15.0f);
}

TEST(Facing, SpaceIsSeenWithItsPlanet) {
  EXPECT_LT(off_middle(viewer_of("asteroids"), {0, 2, -75}), 15.0f);
}

TEST(Facing, ACourtyardIsSeenWithItsFountain) {
  EXPECT_LT(off_middle(viewer_of("far-courtyard"), {2000, 1, 298}), 20.0f);
}

TEST(Facing, ABakedRoomIsSeenWithItsBrickWallAndItsFurniture) {
  EXPECT_LT(off_middle(viewer_of("baked-room"), {0.5f, 0, -2.5f}), 50.0f);
}

// A hall of 8 x 3 x 8 m with a cupboard at +X.
Scene make_hall() {
  Scene hall = with_materials();
  add(hall, inside_out(make_box(vec3(8, 3, 8))), 0, placed(vec3(0, 1.5f, 0)));
  add_block(hall, vec3(2.6f, 0.0f, -0.8f), vec3(3.4f, 1.9f, 0.8f));
  return hall;
}

TEST(Facing, AThingOfTheSameMeshAsTheWallsCounts) {
  Scene hall = with_materials();
  Shape shape = inside_out(make_box(vec3(8, 3, 8)));
  append(shape, transformed(make_box(vec3(0.8f, 1.9f, 1.6f)), placed(vec3(-3.0f, -0.55f, 0.0f))));
  add(hall, shape, 0, placed(vec3(0, 1.5f, 0)));
  EXPECT_NEAR(best_yaw(SceneRays(hall), vec3(0, 1.6f, 0)), -90.0f, 6.0f);
}

TEST(Facing, AColumnBeforeAThingTurnsTheViewAway) {
  Scene hall = make_hall();
  EXPECT_NEAR(best_yaw(SceneRays(hall), vec3(0, 1.6f, 0)), 90.0f, 6.0f);
  add(hall, make_cylinder(0.25f, 3.0f, 48), 0, placed(vec3(1.2f, 1.5f, 0)));
  EXPECT_GT(std::abs(best_yaw(SceneRays(hall), vec3(0, 1.6f, 0)) - 90.0f), 25.0f);
}

TEST(Facing, AnEmptyRoomIsNotSeenByItsCorner) {
  Scene room = with_materials();
  add(room, inside_out(make_box(vec3(5, 2.6f, 4))), 0, placed(vec3(0, 1.3f, 0)));
  EXPECT_EQ(best_yaw(SceneRays(room), vec3(0, 1.6f, 0)), 0.0f);
}

}  // namespace
}  // namespace ods
