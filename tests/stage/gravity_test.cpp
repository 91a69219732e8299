// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/gravity.h"

#include <gtest/gtest.h>

#include "tests/support/stage_scenes.h"

namespace ods {
namespace {

// A scene in which one block is named.
Scene with_name(Scene scene, size_t block, const std::string& name) {
  scene.objects.push_back({name, block, 1});
  return scene;
}

// A floor of 8 x 6 m and one block on it.
Scene make_plinth() {
  Scene scene = with_materials();
  add_block(scene, vec3(-4, -0.1f, -3), vec3(4, 0, 3), 0);
  add_block(scene, vec3(-1, 0, -0.5f), vec3(1, 2, 0.5f));
  return scene;
}

TEST(Gravity, ARoomIsKnownByWhatStandsInIt) {
  const std::string sign = "the file is a room in which things stand with z up";
  EXPECT_EQ(sign_of_z_up(laid_down(make_walled_room())), sign);
  EXPECT_EQ(sign_of_z_up(laid_down(make_walled_room(true))), sign);
  EXPECT_EQ(sign_of_z_up(laid_down(make_simple_room())), sign);
  EXPECT_EQ(sign_of_z_up(laid_down(resized(make_simple_room(), 1000.0f))), sign) << "in millimetres";
}

TEST(Gravity, WhatIsUprightStays) {
  for (const Scene& scene : {make_walled_room(), make_walled_room(true), make_simple_room(), make_courtyard(),
                             make_chair(), make_car(), make_ball(1.0f), make_plinth(), Scene()}) {
    EXPECT_EQ(sign_of_z_up(scene), "");
  }
  EXPECT_EQ(sign_of_z_up(laid_down(make_chair())), "") << "too little to tell";
  EXPECT_EQ(sign_of_z_up(laid_down(make_plinth())), "") << "too little to tell";
}

// The back wall of an upright room is a floor for whom z is up, and pictures lie on it.
TEST(Gravity, PicturesOnAWallDoNotStand) {
  Scene gallery = with_materials();
  add(gallery, inside_out(make_box(vec3(6, 2.6f, 5))), 0, placed(vec3(0, 1.3f, 0)));
  for (int i = 0; i < 8; i++) {
    const float x = -2.8f + 0.7f * static_cast<float>(i);
    add_block(gallery, vec3(x, 1.2f, -2.5f), vec3(x + 0.5f, 1.9f, -2.45f));
  }
  EXPECT_EQ(sign_of_z_up(gallery), "");
}

TEST(Gravity, NamesTell) {
  EXPECT_EQ(sign_of_z_up(with_name(laid_down(make_plinth()), 0, "FloorTiles_2")), "'FloorTiles_2' is level with z up");
  EXPECT_EQ(sign_of_z_up(with_name(laid_down(make_plinth()), 0, "boden")), "'boden' is level with z up");
  EXPECT_EQ(sign_of_z_up(with_name(laid_down(make_plinth()), 0, "Ceiling")), "") << "at the bottom";
  EXPECT_EQ(sign_of_z_up(with_name(laid_down(make_plinth()), 0, "flooring")), "") << "another word";
  EXPECT_EQ(sign_of_z_up(with_name(laid_down(make_plinth()), 1, "floor lamp")), "") << "not level";
  EXPECT_EQ(sign_of_z_up(with_name(make_plinth(), 0, "floor")), "");
  Scene both = laid_down(make_walled_room());
  add_block(both, vec3(-3, -2.6f, -0.1f), vec3(3, -2.5f, 2.6f));
  EXPECT_EQ(sign_of_z_up(with_name(with_name(both, 0, "floor"), both.instances.size() - 1, "ground")), "")
      << "names for y and for z";
}

TEST(Gravity, CamerasTell) {
  Scene scene = laid_down(make_plinth());
  const auto sign_with = [&](float yaw, float pitch, float roll) {
    scene.view_points = {{"camera", vec3(0), yaw, pitch, roll}};
    return sign_of_z_up(scene);
  };
  const std::string sign = "the file's camera has z above it";
  // Level for whom z is up: to +X, and half to +Y.
  EXPECT_EQ(sign_with(90, 0, 90), sign);
  EXPECT_EQ(sign_with(90, 45, 90), sign);
  EXPECT_EQ(sign_with(90, 0, -90), "") << "z is below it";
  EXPECT_EQ(sign_with(0, 0, 90), "") << "x is above it: on edge for either";
  EXPECT_EQ(sign_with(180, -90, 0), "") << "it looks straight down";
  EXPECT_EQ(sign_with(30, -20, 0), "");
}

}  // namespace
}  // namespace ods
