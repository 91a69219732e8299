// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/place.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/stage_scenes.h"

namespace ods {
namespace {

// The viewer of a scene as settle() places him.
ViewPoint viewer_of(Scene& scene) {
  settle(scene);
  return scene.viewing.value().view;
}

vec3 forward_of(const ViewPoint& view) {
  const float yaw = glm::radians(view.yaw);
  return {std::sin(yaw), 0.0f, -std::cos(yaw)};
}

// In free space, on a floor if there should be one, and not within a model.
void expect_good(const Scene& scene, const ViewPoint& view, bool has_floor, const std::string& what) {
  const SceneRays rays(scene);
  EXPECT_GE(free_radius(rays, view.position), 0.99f * kElbowRoom) << what;
  EXPECT_EQ(view_fault(rays, view.position), "") << what;
  EXPECT_GT(surroundings(rays, view.position).fronts, surroundings(rays, view.position).backs) << what;
  if (!has_floor) return;
  const std::optional<float> floor = floor_below(rays, view.position);
  ASSERT_TRUE(floor) << what;
  EXPECT_LE(view.position.y - *floor, kEyeHeight + 0.01f) << what;
  EXPECT_GE(view.position.y - *floor, kMinEyeHeight - 0.01f) << what;
}

TEST(Place, TheViewerStandsOnTheFloorInFreeSpace) {
  const std::pair<const char*, Scene> scenes[] = {
      {"room", make_simple_room()},
      {"walled", make_walled_room()},
      {"window", make_walled_room(true)},
      {"courtyard", make_courtyard()},
      {"cave", make_cave()},
      {"landscape", make_landscape(300.0f)},
      {"far below", moved(make_walled_room(), vec3(0, -40, 0))},
      {"far off", moved(make_courtyard(), vec3(700, 12, -300))},
  };
  for (auto [name, scene] : scenes) {
    const ViewPoint view = viewer_of(scene);
    expect_good(scene, view, true, name);
    EXPECT_FALSE(scene.viewing->is_object) << name;
  }
}

TEST(Place, EyesAreAt160CentimetresOrBelowALowCeiling) {
  Scene room = make_walled_room();
  EXPECT_NEAR(viewer_of(room).position.y, 1.6f, 0.01f);
  Scene cellar = with_materials();
  add(cellar, inside_out(make_box(vec3(5, 1.9f, 5))), 0, placed(vec3(0, 0.95f, 0)));
  EXPECT_NEAR(viewer_of(cellar).position.y, 1.3f, 0.01f) << "60 cm below the ceiling";
}

TEST(Place, TheViewerFacesWhatThereIsToSee) {
  Scene room = make_walled_room();  // its furniture is at -X
  EXPECT_LT(forward_of(viewer_of(room)).x, -0.7f);
  for (Instance& instance : room.instances) instance.row2.w += 100.0f;
  room.viewing.reset();
  EXPECT_LT(forward_of(viewer_of(room)).x, -0.7f);
}

TEST(Place, AnObjectIsBeforeTheViewerAndLevelWithHim) {
  for (const vec3 off : {vec3(0), vec3(500, 20, -300)}) {
    Scene chair = moved(make_chair(), off);
    const ViewPoint view = viewer_of(chair);
    EXPECT_TRUE(chair.viewing->is_object);
    EXPECT_NEAR(view.position.x, off.x, 0.01f);
    EXPECT_NEAR(view.position.z, off.z + 1.5f, 0.3f) << "in front, where +Z is";
    EXPECT_NEAR(view.position.y, off.y + 0.65f, 0.05f) << "a little above its middle";
    EXPECT_EQ(view.yaw, 0.0f);
    expect_good(chair, view, false, "chair");
  }
}

TEST(Place, AnObjectIsAtMost60DegreesWideHoweverItTurns) {
  for (const float yaw : {0.0f, 30.0f, 90.0f}) {
    Scene car = with_materials();
    add(car, make_box(vec3(1.8f, 1.4f, 4.4f)), 0, placed(vec3(0, 0.7f, 0), yaw));
    const ViewPoint view = viewer_of(car);
    for (const Vertex& vertex : car.vertices) {
      const vec3 way = to_world(car.instances[0], vertex.position) - view.position;
      EXPECT_LE(std::abs(glm::degrees(std::atan2(way.x, -way.z))), 30.1f) << yaw;
    }
  }
}

TEST(Place, FlatThingsAreSeenFromAbove) {
  Scene board = with_materials();
  add(board, make_box(vec3(1.0f, 0.04f, 1.0f)), 0);
  const ViewPoint view = viewer_of(board);
  const vec3 way = view.position - board.viewing->middle;
  EXPECT_NEAR(glm::degrees(std::asin(way.y / length(way))), 30.0f, 0.5f);
  Scene picture = with_materials();  // that hangs on a wall, and looks to the left
  add(picture, make_box(vec3(0.04f, 1.0f, 1.0f)), 0);
  const ViewPoint front = viewer_of(picture);
  EXPECT_GT(front.position.x, 0.8f) << "not its edge";
  EXPECT_LT(std::abs(front.position.y - picture.viewing->middle.y), 0.16f);
}

TEST(Place, ACameraThatSeesASpeckIsNotUsed) {
  Scene scene = make_chair();
  scene.view_points.push_back({"far", vec3(0, 0, 40), 0.0f});
  Scene asked = scene, near = scene;
  EXPECT_NE(settle(scene).camera_reason.find("'far'"), std::string::npos);
  EXPECT_FALSE(uses_own_camera(scene));
  EXPECT_EQ(default_view(scene).position, scene.viewing->view.position);
  EXPECT_EQ(settle(asked, {.camera = CameraChoice::kNamed}).camera_reason, "");
  EXPECT_TRUE(uses_own_camera(asked));
  near.view_points[0].position.z = 3.0f;
  EXPECT_EQ(settle(near).camera_reason, "");
  EXPECT_TRUE(uses_own_camera(near));
  settle(near, {.camera = CameraChoice::kNone});
  EXPECT_FALSE(uses_own_camera(near));
}

TEST(Place, CamerasAreChosenByWord) {
  EXPECT_EQ(camera_choice(""), CameraChoice::kFirst);
  EXPECT_EQ(camera_choice("none"), CameraChoice::kNone);
  EXPECT_EQ(camera_choice("dolly"), CameraChoice::kNamed);
}

// 60 degrees is as near as it may be seen whole; nearer than 0.6 m no part of it may be.
TEST(Place, AnObjectIsAsNearAsItMayBe) {
  for (const float radius : {0.25f, 0.3f, 0.5f, 1.0f, 2.0f}) {
    Scene scene = make_ball(radius);
    const ViewPoint view = viewer_of(scene);
    const float nearest = length(view.position - scene.viewing->middle) - radius;
    EXPECT_GE(nearest, kElbowRoom) << radius;
    EXPECT_LT(nearest, std::max(1.1f * kElbowRoom, 1.05f * radius)) << radius;
  }
}

TEST(Place, WhatStandsInTheWayIsAvoided) {
  Scene scene = make_ball(0.5f);
  add(scene, make_sphere(0.5f, 100), 0, placed(vec3(0, 0.5f, 0)));
  add(scene, make_floor(80, 80), 1);
  add_block(scene, vec3(-20, 0, 1.0f), vec3(20, 20, 60));
  const ViewPoint view = viewer_of(scene);
  expect_good(scene, view, false, "a wall in front");
  EXPECT_LT(view.position.z, 1.0f);
}

TEST(Place, AViewPointOfTheSceneWins) {
  Scene scene = make_courtyard();
  scene.view_points.push_back({"own", vec3(1, 2, 3), 40.0f});
  settle(scene);
  EXPECT_EQ(default_view(scene).name, "own");
  scene.view_points.clear();
  EXPECT_EQ(default_view(scene).position, scene.viewing->view.position);
}

TEST(Place, TheViewerIsInTheMidstOfWhatFloats) {
  Scene scene = make_space();
  const ViewPoint view = viewer_of(scene);
  EXPECT_FALSE(scene.viewing->is_object);
  EXPECT_GE(free_radius(SceneRays(scene), view.position), kElbowRoom);
  EXPECT_LT(length(view.position), 30.0f);
}

TEST(Place, NothingHasNoViewer) {
  Scene scene;
  EXPECT_EQ(settle(scene).kind, SceneKind::kNothing);
  EXPECT_FALSE(scene.viewing);
}

TEST(ViewFault, NamesSolidsClosedBoxesAndCeilings) {
  const Scene room = make_walled_room();
  const SceneRays rays(room);
  EXPECT_EQ(view_fault(rays, vec3(0.5f, 1.6f, 0)), "");
  EXPECT_NE(view_fault(rays, vec3(0.5f, 2.57f, 0)).find("3 cm from the nearest"), std::string::npos)
      << view_fault(rays, vec3(0.5f, 2.57f, 0));
  EXPECT_EQ(view_fault(rays, vec3(0.5f, 50.0f, 0)), "") << "outside, all is free";
  Scene ball = make_ball(3.0f);
  for (Material& material : ball.materials) material.double_sided = 0;
  EXPECT_NE(view_fault(SceneRays(ball), vec3(0, 3, 0)).find("inside a solid model"), std::string::npos);
  Scene box = with_materials();
  add(box, inside_out(make_box(vec3(0.2f))), 0);
  EXPECT_NE(view_fault(SceneRays(box), vec3(0)).find("closed space"), std::string::npos);
}

// The unit is the file's, guessed, or given: in each case the look-around sees the scene in metres, once.
TEST(Settle, LetsOthersLookAroundInTheSettledScene) {
  for (const float size : {1.0f, 100.0f}) {
    Scene scene = resized(make_simple_room(), size);
    int looks = 0;
    const Settled settled = settle(scene, {}, [&](const SceneRays& rays, const Survey& survey) {
      looks++;
      EXPECT_EQ(survey.kind, SceneKind::kClosedRoom);
      ASSERT_TRUE(survey.stand && survey.stand->floor);
      EXPECT_NEAR(survey.stand->eye.y - *survey.stand->floor, kEyeHeight, 0.01f);
      EXPECT_NEAR(rays.distance(survey.stand->eye, vec3(0, -1, 0)), kEyeHeight, 0.01f);
    });
    EXPECT_EQ(looks, 1);
    EXPECT_NEAR(settled.metres_per_unit, 1.0f / size, 1e-6f);
  }
}

}  // namespace
}  // namespace ods
