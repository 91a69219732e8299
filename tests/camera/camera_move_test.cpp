// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/camera_move.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ods {
namespace {

StereoCamera at(vec3 position, float yaw = 0.0f) {
  StereoCamera stereo;
  stereo.position = position;
  stereo.yaw = yaw;
  return stereo;
}

void expect_near(vec3 actual, vec3 expected, float tolerance = 1e-5f) {
  for (int i = 0; i < 3; i++) EXPECT_NEAR(actual[i], expected[i], tolerance) << "component " << i;
}

TEST(CameraMove, NoMoveIsNone) {
  EXPECT_FALSE(moves(CameraMove()));
  const StereoCamera stereo = moved(at(vec3(1, 2, 3), 30.0f), CameraMove(), 4.0);
  EXPECT_EQ(stereo.position, vec3(1, 2, 3));
  EXPECT_EQ(stereo.yaw, 30.0f);
}

TEST(CameraMove, TurnsOnTheSpotToTheRightAndComesRound) {
  CameraMove move;
  move.seconds = 8.0;
  move.turns = 2.0;
  EXPECT_TRUE(moves(move));
  EXPECT_NEAR(moved(at(vec3(1)), move, 1.0).yaw, 90.0f, 1e-4f);
  EXPECT_EQ(moved(at(vec3(1)), move, 1.0).position, vec3(1));
  EXPECT_EQ(moved(at(vec3(1), 10.0f), move, 8.0).yaw, 10.0f) << "a loop closes exactly";
  EXPECT_NEAR(moved(at(vec3(1)), move, 9.0).yaw, 90.0f, 1e-4f) << "and goes on";
  move.turns = -2.0;
  EXPECT_NEAR(moved(at(vec3(1)), move, 1.0).yaw, 270.0f, 1e-4f);
}

// A point straight ahead at the distance of the pivot stays straight ahead there.
TEST(CameraMove, GoesAroundAPivotAndFacesIt) {
  CameraMove move;
  move.seconds = 10.0;
  move.turns = 1.0;
  move.pivot = vec3(2.0f, 0.0f, -3.0f);
  const StereoCamera start = at(vec3(2.0f, 1.6f, 1.0f));
  for (const double time : {0.0, 1.0, 2.5, 7.0}) {
    const StereoCamera stereo = moved(start, move, time);
    const Camera camera = make_camera(stereo);
    expect_near(stereo.position - 4.0f * camera.back, vec3(2.0f, 1.6f, -3.0f));
  }
  expect_near(moved(start, move, 2.5).position, vec3(-2.0f, 1.6f, -3.0f));
}

TEST(CameraMove, FliesThroughEveryPlaceAndStays) {
  CameraMove move;
  move.seconds = 10.0;
  move.fly_to = {vec3(4, 0, 0), vec3(4, 0, 4), vec3(4, 0, 4), vec3(0, 2, 4)};
  const StereoCamera start = at(vec3(0));
  expect_near(moved(start, move, -1.0).position, vec3(0));
  expect_near(moved(start, move, 0.0).position, vec3(0));
  expect_near(moved(start, move, 10.0).position, vec3(0, 2, 4));
  expect_near(moved(start, move, 99.0).position, vec3(0, 2, 4));
  float nearest[2] = {1e9f, 1e9f}, longest = 0.0f;
  vec3 before = start.position;
  for (int i = 1; i <= 1000; i++) {
    const vec3 p = moved(start, move, 0.01 * i).position;
    nearest[0] = min(nearest[0], length(p - vec3(4, 0, 0)));
    nearest[1] = min(nearest[1], length(p - vec3(4, 0, 4)));
    longest = max(longest, length(p - before));
    before = p;
  }
  EXPECT_LT(nearest[0], 0.02f);
  EXPECT_LT(nearest[1], 0.02f);
  // Smoothstep is fastest in the middle: one and a half times the mean. The way is somewhat longer than its chords.
  EXPECT_GT(longest, 1.5f * 12.5f / 1000.0f);
  EXPECT_LT(longest, 1.5f * 14.0f / 1000.0f);
}

TEST(CameraMove, AStraightFlightIsStraight) {
  CameraMove move;
  move.seconds = 2.0;
  move.fly_to = {vec3(1, 0, -2)};
  expect_near(moved(at(vec3(0)), move, 1.0).position, vec3(0.5f, 0.0f, -1.0f));
  const float eased = 0.25f * 0.25f * (3.0f - 0.5f);
  expect_near(moved(at(vec3(0)), move, 0.5).position, eased * vec3(1, 0, -2));
  move.fly_to = {vec3(0)};
  expect_near(moved(at(vec3(0)), move, 1.0).position, vec3(0));
}

}  // namespace
}  // namespace ods
