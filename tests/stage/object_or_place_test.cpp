// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/object_or_place.h"

#include <gtest/gtest.h>

#include "ods/stage/place.h"
#include "tests/support/stage_scenes.h"

namespace ods {
namespace {

SceneKind kind_of(const Scene& scene, TakenFor taken_for = TakenFor::kAuto) {
  return survey(SceneRays(scene), 1.0f, taken_for).kind;
}

PlaceSigns signs_of(const Scene& scene) {
  const SceneRays rays(scene);
  return place_signs(rays, survey(rays, 1.0f, TakenFor::kPlace), 1.0f);
}

// A bed, 2 m long, with head and foot, in centimetres: a viewer 1.6 cm high would stand on it.
Scene make_bed() {
  Scene scene = with_materials();
  add_block(scene, vec3(-80, 20, -100), vec3(80, 50, 100));
  add_block(scene, vec3(-80, 0, -105), vec3(80, 100, -100));
  add_block(scene, vec3(-80, 0, 100), vec3(80, 60, 105));
  for (const float x : {-80.0f, 72.0f}) {
    for (const float z : {-98.0f, 90.0f}) add_block(scene, vec3(x, 0, z), vec3(x + 8, 20, z + 8));
  }
  return scene;
}

// A cupboard with shelves in millimetres, as hollow as a room and closed from all sides.
Scene make_cupboard() {
  Scene scene = with_materials();
  for (const float y : {0.0f, 500.0f, 1000.0f}) add_block(scene, vec3(-400, y, -300), vec3(400, y + 20, 300));
  for (const float x : {-400.0f, 380.0f}) add_block(scene, vec3(x, 0, -300), vec3(x + 20, 1020, 300));
  for (const float z : {-300.0f, 280.0f}) add_block(scene, vec3(-400, 0, z), vec3(400, 1020, z + 20));
  for (int i = 0; i < 12; i++) {
    const float x = -390.0f + 65.0f * static_cast<float>(i);
    add_block(scene, vec3(x, 0, 300), vec3(x + 30, 1020, 310));
  }
  return scene;
}

TEST(ObjectOrPlace, FurnitureOfAnotherUnitIsNoPlace) {
  EXPECT_EQ(kind_of(make_bed()), SceneKind::kObject);
  EXPECT_EQ(kind_of(make_cupboard()), SceneKind::kObject);
  EXPECT_EQ(kind_of(resized(make_bed(), 10.0f)), SceneKind::kObject) << "in millimetres";
}

// Thick walls show no backs, so backs alone do not decide.
TEST(ObjectOrPlace, PlacesWithThickWallsArePlaces) {
  EXPECT_EQ(signs_of(make_walled_room()).backs_outside, 0.0f);
  EXPECT_EQ(kind_of(make_walled_room()), SceneKind::kClosedRoom);
  EXPECT_EQ(kind_of(resized(make_walled_room(), 15.0f)), SceneKind::kClosedRoom);
  EXPECT_EQ(kind_of(make_courtyard()), SceneKind::kOpenPlace);
  EXPECT_EQ(kind_of(make_landscape(300.0f)), SceneKind::kOpenPlace);
}

// A ball with another inside it, whose backs the viewer between them would see.
TEST(ObjectOrPlace, AHollowModelIsNoPlace) {
  Scene scene = make_cave();
  EXPECT_EQ(kind_of(scene), SceneKind::kClosedRoom);
  PlaceSigns signs = signs_of(scene);
  EXPECT_FALSE(is_object(signs));
  signs.backs_inside = 0.2f;
  EXPECT_TRUE(is_object(signs)) << "neither level nor upright";
  signs.level = 1.0f, signs.below = 0.0f;
  EXPECT_FALSE(is_object(signs)) << "a room whose walls face outwards";
  signs.extent = 2.0f * kLargestSolid;
  EXPECT_TRUE(is_object(signs));
}

TEST(ObjectOrPlace, ASheetOfPaperIsNoGround) {
  Scene paper = with_materials();
  add_block(paper, vec3(-13, 0, -12), vec3(13, 0.5f, 12));
  EXPECT_EQ(kind_of(paper), SceneKind::kObject);
}

TEST(ObjectOrPlace, TheUserDecides) {
  EXPECT_EQ(kind_of(make_bed(), TakenFor::kPlace), SceneKind::kOpenPlace);
  EXPECT_EQ(kind_of(make_walled_room(), TakenFor::kObject), SceneKind::kObject);
  EXPECT_EQ(kind_of(make_ball(0.2f), TakenFor::kPlace), SceneKind::kObject) << "nobody can stand in it";
  Scene bed = make_bed();
  const Settled settled = settle(bed, {.taken_for = TakenFor::kPlace});
  EXPECT_EQ(settled.kind, SceneKind::kOpenPlace);
  EXPECT_FALSE(settled.doubted);
}

TEST(ObjectOrPlace, DoubtIsSaid) {
  Scene bed = make_bed();
  EXPECT_TRUE(settle(bed).doubted);
  EXPECT_NE(settle_doubt(SceneKind::kObject).find("`as` place"), std::string::npos);
  EXPECT_NE(settle_doubt(SceneKind::kClosedRoom).find("`unit` cm"), std::string::npos);
  Scene chair = make_chair(), room = make_walled_room();
  EXPECT_FALSE(settle(chair).doubted);
  EXPECT_FALSE(settle(room).doubted);
}

}  // namespace
}  // namespace ods
