// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes that move, rendered.
#include <gtest/gtest.h>

#include <cmath>

#include "ods/cpu/render.h"
#include "tests/moving_files.h"
#include "tests/scenes.h"

namespace ods {
namespace {

RenderOptions small(int width = 64, int samples = 4) {
  RenderOptions options;
  options.width = width;
  options.samples = samples;
  options.bounces = 2;
  return options;
}

// One clip of one track, and it plays.
void play_track(Scene& scene, Property property, int target, const Keyframes& keys) {
  Clip clip{"test", static_cast<double>(keys.times.back()), {{property, target, keys}}};
  scene.animation.clips.push_back(clip);
  play(scene.animation, "");
}

// A floor that stands still, a ball that moves from x = -1 to 1 and grows from nothing, both before the camera.
Scene make_ball() {
  Scene scene;
  const int grey = add_material(scene, matte(vec3(0.5f))), lamp = add_material(scene, glow(vec3(3.0f)));
  add_rectangle(scene, vec3(-2, -1, 0), vec3(4, 0, 0), vec3(0, 0, -4), grey);
  add_sphere(scene, vec3(0.0f), 0.5f, lamp);
  MovingNode node;
  node.translation.z = -2.0;
  scene.animation.nodes.push_back(node);
  MovingInstance ball{1, 0, -1, glm::dmat4(1.0), vec3(-0.5f), vec3(0.5f)};
  scene.animation.instances.push_back(ball);
  play_track(scene, Property::kTranslation, 0, {Interpolation::kLinear, false, 3, {0, 1}, {-1, 0, -2, 1, 0, -2}});
  play_track(scene, Property::kScale, 0, {Interpolation::kLinear, false, 3, {0, 1}, {0, 0, 0, 1, 1, 1}});
  return scene;
}

bool same_pixels(const Picture& a, const Picture& b) {
  if (a.eyes.size() != b.eyes.size()) return false;
  for (size_t i = 0; i < a.eyes.size(); i++) {
    if (a.eyes[i].radiance.pixels != b.eyes[i].radiance.pixels || a.eyes[i].depth.pixels != b.eyes[i].depth.pixels ||
        a.eyes[i].normal.pixels != b.eyes[i].normal.pixels) {
      return false;
    }
  }
  return true;
}

Picture alone(Scene scene, double time) {
  set_time(scene, time);
  return render_cpu(scene, {}, small());
}

TEST(MotionRender, AFrameAloneIsTheFrameOfTheRun) {
  GltfBuilder skinned = make_skinned(false);
  skinned.node(0).erase("translation");
  skinned.node(1)["translation"] = {-1.0, 0.0, 2.0};  // behind the camera, its front towards it
  Scene figure = skinned.load();
  play(figure.animation, "");
  figure.environment.radiance = vec3(1.0f);
  for (const Scene& start : {make_ball(), figure}) {
    Scene scene = start;
    set_time(scene, 0.0);
    CpuRenderer renderer(scene);
    Picture last;
    double last_time = -1.0;
    for (const double time : {0.0, 0.3, 1.0, 0.7, 0.7}) {
      renderer.update(set_time(scene, time));
      const Picture frame = renderer.render({}, small());
      EXPECT_TRUE(same_pixels(frame, alone(start, time))) << time;
      EXPECT_EQ(same_pixels(frame, last), time == last_time) << time;
      last = frame;
      last_time = time;
    }
  }
}

TEST(MotionRender, WhatMovedIsWhereItIsAndNowhereElse) {
  Scene scene = make_ball();
  set_time(scene, 0.0);
  CpuRenderer renderer(scene);
  RenderOptions options = small(256, 1);
  options.eyes = Eyes::kMonoEye;
  const auto depth_at = [&](double azimuth) {
    const Picture picture = renderer.render({}, options);
    const int x = static_cast<int>((azimuth / (2.0 * std::acos(-1.0)) + 0.5) * 256.0);
    return *picture.eyes[0].depth.at(x, 64);
  };
  EXPECT_EQ(depth_at(0.0), kFarDepth) << "scaled to nothing";
  renderer.update(set_time(scene, 0.5));
  EXPECT_NEAR(depth_at(0.0), 1.75f, 0.01f) << "half its size, in the middle";
  renderer.update(set_time(scene, 1.0));
  EXPECT_EQ(depth_at(0.0), kFarDepth);
  EXPECT_NEAR(depth_at(std::atan2(1.0, 2.0)), std::sqrt(5.0f) - 0.5f, 0.01f);
  renderer.update(set_time(scene, 0.0));
  EXPECT_EQ(depth_at(std::atan2(1.0, 2.0)), kFarDepth);
}

// The lamp's light moves with it: the floor is brightest below it.
TEST(MotionRender, MovingLampsLightWhatIsNearThem) {
  Scene scene = make_ball();
  const auto floor_brightness = [&](double time, float x) {
    set_time(scene, time);
    RenderOptions options = small(256, 16);
    options.eyes = Eyes::kMonoEye;
    const Picture picture = render_cpu(scene, {}, options);
    const vec2 uv = direction_to_lat_long(normalize(vec3(x, -1.0f, -2.0f)));
    return *picture.eyes[0].radiance.at(static_cast<int>(uv.x * 256.0f), static_cast<int>(uv.y * 128.0f));
  };
  EXPECT_EQ(floor_brightness(0.0, 0.0f), 0.0f);
  EXPECT_GT(floor_brightness(1.0, 1.0f), 2.0f * floor_brightness(1.0, -1.0f));
}

}  // namespace
}  // namespace ods
