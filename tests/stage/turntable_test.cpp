// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/turntable.h"

#include <gtest/gtest.h>

#include "ods/kernel/surface.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/scene/motion.h"
#include "tests/support/stage_scenes.h"

namespace ods {
namespace {

vec3 place_of(const Scene& scene, size_t instance) {
  return to_world(scene.instances[instance], vec3(0));
}

TEST(Turntable, TurnsAnObjectClockwiseAboutItsMiddle) {
  Scene scene = with_materials();
  add(scene, make_box(vec3(0.1f)), 0, placed(vec3(5, 1, 2)));  // 2 m in front of the axis
  turn_object(scene, vec3(5, 0, 0), 1.0, 4.0, 4.0);
  EXPECT_DOUBLE_EQ(length_of(scene.animation), 4.0);
  const std::pair<double, vec3> places[] = {
      {0.0, vec3(5, 1, 2)}, {1.0, vec3(3, 1, 0)}, {2.0, vec3(5, 1, -2)}, {3.0, vec3(7, 1, 0)}, {4.0, vec3(5, 1, 2)}};
  for (const auto& [time, place] : places) {
    set_time(scene, time);
    EXPECT_LT(length(place_of(scene, 0) - place), 1e-4f) << time;
  }
}

TEST(Turntable, TurnsAtConstantSpeedAndOnAfterItsDuration) {
  Scene scene = with_materials();
  add(scene, make_box(vec3(0.1f)), 0, placed(vec3(0, 0, 1)));
  turn_object(scene, vec3(0), -2.0, 10.0, 25.0);
  for (const double time : {0.3, 4.9, 10.0, 13.7, 24.5}) {
    set_time(scene, time);
    const auto angle = static_cast<float>(2.0 * 3.14159265358979 * 0.2 * time);
    EXPECT_LT(length(place_of(scene, 0) - vec3(std::sin(angle), 0, std::cos(angle))), 2e-4f) << time;
  }
}

TEST(Turntable, LightsViewPointsAndCatchersStay) {
  Scene scene = with_materials();
  add(scene, make_box(vec3(0.1f)), 0, placed(vec3(1, 0, 0)));
  add(scene, make_floor(4, 4), 1, placed(vec3(0.5f, 0, 0)));
  scene.instances[1].role = kCatcher;
  PunctualLight lamp;
  lamp.position = vec3(0, 2, 1);
  scene.lights.push_back(lamp);
  scene.view_points.push_back({"own", vec3(0, 1, 3)});
  turn_object(scene, vec3(0), 1.0, 4.0, 4.0);
  set_time(scene, 1.3);
  EXPECT_GT(length(place_of(scene, 0) - vec3(1, 0, 0)), 0.5f);
  EXPECT_EQ(place_of(scene, 1), vec3(0.5f, 0, 0));
  EXPECT_EQ(scene.lights[0].position, vec3(0, 2, 1));
  EXPECT_EQ(scene.view_points[0].position, vec3(0, 1, 3));
}

TEST(Turntable, WhatMovesGoesOnMovingOnTheTable) {
  Scene plain = find_builtin("toys")->make();  // nodes, skins, morphs, lamps
  Scene turning = plain;
  play(plain.animation, "");
  play(turning.animation, "");
  turn_object(turning, vec3(0), 1.0, 8.0, 8.0);
  set_time(plain, 2.0);
  set_time(turning, 2.0);  // a quarter of a turn: +Z is at -X
  const auto turned_place = [](vec3 p) { return vec3(-p.z, p.y, p.x); };
  for (size_t i = 0; i < plain.instances.size(); i++) {
    const Mesh& mesh = plain.meshes[static_cast<size_t>(plain.instances[i].mesh)];
    for (const uint k : {0u, mesh.vertex_count / 2}) {
      const auto at = [&](const Scene& scene) {
        return to_world(scene.instances[i], scene.vertices[mesh.first_vertex + k].position);
      };
      ASSERT_LT(length(at(turning) - turned_place(at(plain))), 1e-3f) << i;
    }
  }
  for (size_t i = 0; i < plain.lights.size(); i++) {
    EXPECT_LT(length(turning.lights[i].position - plain.lights[i].position), 1e-5f);
  }
}

TEST(Turntable, HiddenThingsStayHidden) {
  Scene scene = with_materials();
  for (const float x : {0.0f, 1.0f}) add(scene, make_box(vec3(0.1f)), 0, placed(vec3(x, 0, 0)));
  scene.hidden = {0, 1};
  turn_object(scene, vec3(0), 1.0, 4.0, 4.0);
  set_time(scene, 1.0);
  EXPECT_FALSE(is_hidden(scene, 0));
  EXPECT_TRUE(is_hidden(scene, 1));
}

}  // namespace
}  // namespace ods
