// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes that move, rendered.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ods/camera/stereo_camera.h"
#include "ods/render/cpu/render.h"
#include "ods/render/render_target.h"
#include "ods/scene/shutter.h"
#include "tests/support/moving_files.h"
#include "tests/support/scenes.h"

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
      const Picture frame = renderer.render(StereoCamera(), small());
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
    const Picture picture = renderer.render(StereoCamera(), options);
    const int x = static_cast<int>((azimuth / (2.0 * std::acos(-1.0)) + 0.5) * 256.0);
    return *picture.eyes[0].depth.at(x, 64);
  };
  EXPECT_EQ(depth_at(0.0), kFarDepth) << "scaled to zero";
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

// --- motion blur

// A glowing half plane at z = -2 whose right edge goes from x = -0.5 to 0.5 while the shutter is open from 0 s to 1 s;
// bent: by a morph target instead of its node.
Scene make_edge(bool bent) {
  Scene scene;
  add_rectangle(scene, vec3(-6, -1, -2), vec3(6, 0, 0), vec3(0, 2, 0), add_material(scene, glow(vec3(1.0f))));
  scene.animation.instances.push_back({0, -1, -1, glm::dmat4(1.0), vec3(-6, -1, -2), vec3(0, 1, -2)});
  if (bent) {
    Deformation deformation;
    deformation.rest = scene.vertices;
    deformation.targets.push_back({std::vector<vec3>(4, vec3(1, 0, 0)), {}, {}});
    deformation.weights = 0;
    scene.animation.deformations.push_back(deformation);
    scene.animation.weights.push_back({0.0});
    scene.animation.instances[0].deformation = 0;
    play_track(scene, Property::kWeights, 0, {Interpolation::kLinear, false, 1, {0, 1}, {-0.5f, 0.5f}});
  } else {
    scene.animation.nodes.emplace_back();
    scene.animation.instances[0].node = 0;
    play_track(scene, Property::kTranslation, 0, {Interpolation::kLinear, false, 3, {0, 1}, {-0.5f, 0, 0, 0.5f, 0, 0}});
  }
  return scene;
}

// The share of the time for which the edge has passed a direction.
void expect_blurred_edge(const Picture& picture) {
  const Image& image = picture.eyes[0].radiance;
  double worst = 0.0;
  for (int x = 0; x < image.width; x++) {
    double covered = 0.0;  // the mean over the pixel
    for (int i = 0; i < 16; i++) {
      const double azimuth = ((x + (i + 0.5) / 16.0) / image.width - 0.5) * 2.0 * std::acos(-1.0);
      if (std::abs(azimuth) < 1.2) covered += std::clamp(0.5 - 2.0 * std::tan(azimuth), 0.0, 1.0) / 16.0;
    }
    if (std::abs((x + 0.5) / image.width - 0.5) * 2.0 * std::acos(-1.0) > 1.1) continue;
    worst = std::max(worst, std::abs(covered - static_cast<double>(*image.at(x, image.height / 2))));
  }
  EXPECT_LT(worst, 0.02);
}

RenderOptions sharp() {
  RenderOptions options = small(128, 256);
  options.eyes = Eyes::kMonoEye;
  options.filter = PixelFilter::kBox;
  options.bounces = 0;
  return options;
}

TEST(MotionBlur, AMovingEdgeIsAsBrightAsItsTimeThere) {
  for (const bool bent : {false, true}) {
    SCOPED_TRACE(bent);
    Scene scene = make_edge(bent);
    open_shutter(scene, 0.0, 1.0);
    expect_blurred_edge(render_cpu(scene, {}, sharp()));
  }
}

TEST(MotionBlur, AMovingCameraSeesTheSame) {
  Scene scene = make_edge(false);
  set_time(scene, 0.5);  // the edge stands at x = 0
  std::vector<StereoCamera> cameras(5);
  for (size_t i = 0; i < cameras.size(); i++) cameras[i].position.x = 0.5f - 0.25f * static_cast<float>(i);
  expect_blurred_edge(CpuRenderer(scene).render(cameras, sharp()));
}

// A camera that turns by 40 degrees: the edge that stands at azimuth 0 is spread evenly over -20 .. 20.
TEST(MotionBlur, ATurningCameraSpreadsEvenly) {
  Scene scene = make_edge(false);
  set_time(scene, 0.5);
  std::vector<StereoCamera> cameras(5);
  for (size_t i = 0; i < cameras.size(); i++) cameras[i].yaw = -20.0f + 10.0f * static_cast<float>(i);
  const Picture picture = CpuRenderer(scene).render(cameras, sharp());
  for (int x = 50; x < 78; x++) {
    const double azimuth = ((x + 0.5) / 128.0 - 0.5) * 360.0;
    EXPECT_NEAR(*picture.eyes[0].radiance.at(x, 32), std::clamp(0.5 - azimuth / 40.0, 0.0, 1.0), 0.03) << azimuth;
  }
}

// A quarter turn within the shutter would cut 29 % off the circle between two keys; between five it is 2 %.
TEST(MotionBlur, RotationsStayRound) {
  Scene scene;
  add_sphere(scene, vec3(1, 0, 0), 0.1f, add_material(scene, glow(vec3(1.0f))));
  scene.animation.nodes.emplace_back();
  scene.animation.instances.push_back({0, 0, -1, glm::dmat4(1.0), vec3(0.9f, -0.1f, -0.1f), vec3(1.1f, 0.1f, 0.1f)});
  const float s = std::sqrt(0.5f);
  play_track(scene, Property::kRotation, 0, {Interpolation::kLinear, true, 4, {0, 1}, {0, 0, 0, 1, 0, s, 0, s}});
  open_shutter(scene, 0.0, 1.0);
  ASSERT_EQ(scene.motion_poses.size(), size_t(kShutterKeys));
  const auto tip = [&](double t) {
    const auto key = static_cast<size_t>(t * (kShutterKeys - 1));
    const MotionPose &a = scene.motion_poses[key], &b = scene.motion_poses[std::min(key + 1, size_t(kShutterKeys - 1))];
    const float share = static_cast<float>(t * (kShutterKeys - 1) - static_cast<double>(key));
    return vec3(mix(a.row0.x, b.row0.x, share), mix(a.row1.x, b.row1.x, share), mix(a.row2.x, b.row2.x, share));
  };
  for (double t = 0.0; t <= 1.0; t += 0.0625) EXPECT_NEAR(length(tip(t)), 1.0f, 0.02f) << t;
  EXPECT_NEAR(tip(1.0).z, -1.0f, 1e-6f);
}

TEST(MotionBlur, AnOpenShutterChangesNoStillScene) {
  Scene scene;
  add_sphere(scene, vec3(0, 0, -2), 1.0f, add_material(scene, glow(vec3(1.0f))));
  const Picture closed = render_cpu(scene, {}, small());
  open_shutter(scene, 0.0, 1.0);
  EXPECT_TRUE(same_pixels(closed, render_cpu(scene, {}, small())));
}

// Lamps in the dark: what light sampling finds of a moving lamp is what scattered rays find.
TEST(MotionBlur, BothWaysToFindAMovingLampAgree) {
  Scene scene;
  add_rectangle(scene, vec3(-2, -1, 0), vec3(4, 0, 0), vec3(0, 0, -4), add_material(scene, matte(vec3(0.8f))));
  add_sphere(scene, vec3(0.0f), 0.5f, add_material(scene, glow(vec3(3.0f))), 12);
  MovingNode node;
  scene.animation.nodes.push_back(node);
  scene.animation.instances.push_back({1, 0, -1, glm::dmat4(1.0), vec3(-0.5f), vec3(0.5f)});
  play_track(scene, Property::kTranslation, 0, {Interpolation::kLinear, false, 3, {0, 1}, {-1, 0, -2, 1, 0, -2}});
  open_shutter(scene, 0.0, 1.0);
  double means[2] = {};
  for (int way = 0; way < 2; way++) {
    RenderOptions options = small(64, 256);
    options.eyes = Eyes::kMonoEye;
    options.light_sampling = way == 0 ? LightSampling::kLightsOnly : LightSampling::kBsdfOnly;
    const Picture picture = render_cpu(scene, {}, options);
    for (int y = 20; y < 32; y++) {
      for (int x = 24; x < 40; x++) means[way] += static_cast<double>(*picture.eyes[0].radiance.at(x, y)) / (12 * 16);
    }
  }
  EXPECT_NEAR(means[0] / means[1], 1.0, 0.02) << means[0];
}

TEST(MotionBlur, FramesOfARunAreThoseAlone) {
  const Scene start = make_ball();
  Scene scene = start;
  open_shutter(scene, 0.0, 0.1);
  CpuRenderer renderer(scene);
  for (const double time : {0.3, 0.9, 0.9, 1.5, 0.6}) {
    renderer.update(open_shutter(scene, time - 0.1, time + 0.1));
    Scene other = start;
    open_shutter(other, time - 0.1, time + 0.1);
    EXPECT_TRUE(same_pixels(renderer.render(StereoCamera(), small()), render_cpu(other, {}, small()))) << time;
  }
}

// The points of the depth layer, and their places at another time: the ball's points move with it, the floor's stay.
TEST(MotionRender, CenterHitsFollowWhatMoves) {
  Scene scene = make_ball();
  set_time(scene, 0.4);
  const StereoCamera stereo;
  const RenderOptions options = with_height(small(), stereo);
  const CpuRenderer renderer(scene);
  const Picture picture = renderer.render(stereo, options);
  const std::vector<std::vector<Hit>> hits = renderer.center_hits(stereo, options);
  const auto ball_at = [](double t) { return glm::dvec3(2.0 * t - 1.0, 0.0, -2.0); };
  ASSERT_EQ(hits.size(), 2u);
  int moved = 0;
  for (const double time : {0.4, 0.6}) {
    set_time(scene, time);
    for (size_t eye = 0; eye < 2; eye++) {
      for (size_t i = 0; i < hits[eye].size(); i++) {
        const Hit& hit = hits[eye][i];
        const int x = static_cast<int>(i) % options.width, y = static_cast<int>(i) / options.width;
        ASSERT_EQ(hit.t < 0.0f ? kFarDepth : hit.t, *picture.eyes[eye].depth.at(x, y));
        if (hit.t < 0.0f) continue;
        const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(options.width),
                      (static_cast<float>(y) + 0.5f) / static_cast<float>(options.height));
        const Ray ray = camera_ray(make_camera(stereo), picture.eyes[eye].eye, uv);
        glm::dvec3 expected(ray.origin + ray.direction * hit.t);
        if (hit.instance == 1 && time == 0.6)
          expected = ball_at(0.6) + (expected - ball_at(0.4)) * (0.6 / 0.4), moved++;
        ASSERT_LT(length(glm::dvec3(point_of(scene, hit)) - expected), 2e-6) << time;
      }
    }
  }
  EXPECT_GT(moved, 5);
}

// Changes that add up until they are applied.
TEST(MotionRender, TimeMayPassUnseenBetweenFrames) {
  Scene scene = make_ball();
  set_time(scene, 0.2);
  CpuRenderer renderer(scene);
  SceneChange change = set_time(scene, 0.9);
  add_change(change, set_time(scene, 0.5));
  renderer.update(change);
  EXPECT_TRUE(same_pixels(renderer.render(StereoCamera(), small()), alone(make_ball(), 0.5)));
}

}  // namespace
}  // namespace ods
