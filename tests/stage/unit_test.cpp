// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/unit.h"

#include <gtest/gtest.h>

#include "ods/base/error.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/scene/motion.h"
#include "ods/stage/place.h"
#include "tests/support/stage_scenes.h"

namespace ods {
namespace {

float guessed(const Scene& scene) {
  const SceneRays rays(scene);
  const UnitGuess guess = guess_unit(rays);
  EXPECT_EQ(guess.reason.empty(), guess.metres == 1.0f) << guess.reason;
  return guess.metres;
}

TEST(Unit, MetresStayMetresWhereverPeopleMeetThatSize) {
  EXPECT_EQ(guessed(Scene()), 1.0f);
  EXPECT_EQ(guessed(make_chair()), 1.0f);
  EXPECT_EQ(guessed(make_car()), 1.0f);
  EXPECT_EQ(guessed(make_walled_room()), 1.0f);
  EXPECT_EQ(guessed(resized(make_walled_room(), 15.0f)), 1.0f) << "a hall, 39 m high";
  EXPECT_EQ(guessed(make_courtyard()), 1.0f);
  EXPECT_EQ(guessed(make_landscape(2000.0f, 200.0f)), 1.0f);
  EXPECT_EQ(guessed(make_cave()), 1.0f);
  EXPECT_EQ(guessed(make_space()), 1.0f);
}

TEST(Unit, RoomsOfAnotherUnitAreRecognised) {
  EXPECT_EQ(guessed(resized(make_simple_room(), 100.0f)), 0.01f);
  EXPECT_EQ(guessed(resized(make_walled_room(), 100.0f)), 0.01f);
  EXPECT_EQ(guessed(resized(make_simple_room(), 1000.0f)), 0.001f) << "a room of 6 kilometres";
  EXPECT_EQ(guessed(resized(make_walled_room(), 1.0f / 0.0254f)), 0.0254f);
  EXPECT_EQ(guessed(resized(make_simple_room(), 0.001f)), 1000.0f) << "a room of 6 millimetres";
  EXPECT_EQ(guessed(resized(make_walled_room(), 0.001f)), 1000.0f);
  EXPECT_EQ(guessed(resized(make_simple_room(), 0.1f)), 10.0f) << "its walls show that it is no doll's house";
  EXPECT_EQ(guessed(resized(make_walled_room(), 0.1f)), 1.0f) << "a doll's house";
  EXPECT_EQ(guessed(resized(make_landscape(500.0f), 100.0f)), 0.01f) << "a place of 50 km";
}

TEST(Unit, ASkyDomeIsNoHugeRoom) {
  Scene scene = make_landscape(200.0f);
  add(scene, inside_out(make_sphere(500.0f, 32)), 0);
  EXPECT_EQ(guessed(scene), 1.0f);
}

TEST(Unit, ObjectsTooSmallOrLargeForStereoAreShownAsModels) {
  for (const float size : {0.02f, 0.3f, 15.0f, 100.0f, 1000.0f}) {
    Scene scene = resized(make_chair(), size);
    const Settled settled = settle(scene);
    EXPECT_NE(settled.unit_reason.find("shown as a model"), std::string::npos) << settled.unit_reason;
    EXPECT_NEAR(distance_to_see(scene, core_bounds(scene)), kModelSize, 0.01f);
    EXPECT_NEAR(length(default_view(scene).position - scene.viewing->middle), kModelSize, 0.02f) << "60 degrees wide";
  }
  Scene composed = resized(make_chair(), 15.0f);
  composed.view_points.push_back({"own", vec3(0, 5, 30)});
  EXPECT_EQ(settle(composed).metres_per_unit, 1.0f) << "whoever placed a camera knew the size";
}

TEST(Unit, AGivenUnitIsNotQuestioned) {
  Scene scene = resized(make_walled_room(), 100.0f);
  const Settled settled = settle(scene, {.metres_per_unit = 0.02f});
  EXPECT_EQ(settled.metres_per_unit, 0.02f);
  EXPECT_EQ(settled.unit_reason, "");
  EXPECT_NEAR(scene_bounds(scene).high.x, 6.4f, 1e-4f);
}

// One eye's picture, so small that it is quick.
std::vector<float> picture_of(const Scene& scene, vec3 eye) {
  StereoCamera camera;
  camera.position = eye;
  camera.ipd = 0.0f;
  RenderOptions options;
  options.width = 48, options.samples = 16, options.bounces = 3, options.eyes = Eyes::kMonoEye;
  options.threads = 2, options.layers = false;
  return render_cpu(scene, camera, options).eyes[0].radiance.pixels;
}

// A power of two changes no mantissa, so that pictures stay the same but for the offsets of rays.
void expect_same_picture(const Scene& scene, vec3 eye) {
  Scene larger = scene;
  scale_scene(larger, 4.0f);
  const std::vector<float> was = picture_of(scene, eye), is = picture_of(larger, 4.0f * eye);
  double difference = 0.0, sum = 0.0;
  for (size_t i = 0; i < was.size(); i++) {
    difference += std::abs(static_cast<double>(was[i]) - static_cast<double>(is[i]));
    sum += static_cast<double>(was[i]);
  }
  ASSERT_GT(sum, 0.0);
  EXPECT_LT(difference / sum, 0.002);
}

TEST(ScaleScene, LeavesThePictureAsItWas) {
  Scene lit = make_walled_room();
  PunctualLight lamp;
  lamp.position = vec3(0, 2.2f, 0), lamp.intensity = vec3(3), lamp.range = 5.0f;
  lit.lights.push_back(lamp);
  expect_same_picture(lit, vec3(0.5f, 1.5f, 0.3f));
  Scene sunny = make_courtyard();
  sunny.lights.push_back(make_sun(30, 50, vec3(3)));
  sunny.environment.radiance = vec3(0.5f);
  expect_same_picture(sunny, vec3(0.5f, 1.5f, 0.3f));
}

TEST(ScaleScene, ScalesWhatMoves) {
  const Scene toys = find_builtin("toys")->make();  // nodes, skins, morphs, lamps
  Scene small = toys, large = toys;
  scale_scene(large, 4.0f);
  for (Scene* scene : {&small, &large}) play(scene->animation, "");
  for (const double time : {0.0, 2.3}) {
    set_time(small, time);
    set_time(large, time);
    for (size_t i = 0; i < small.instances.size(); i++) {
      const Mesh& mesh = small.meshes[static_cast<size_t>(small.instances[i].mesh)];
      const auto at = [&](const Scene& scene, uint k) {
        return to_world(scene.instances[i], scene.vertices[mesh.first_vertex + k].position);
      };
      for (uint k = 0; k < mesh.vertex_count; k += 1 + mesh.vertex_count / 50) {
        ASSERT_LT(length(at(large, k) - 4.0f * at(small, k)), 1e-3f) << i;
      }
    }
    for (size_t i = 0; i < small.lights.size(); i++) {
      const PunctualLight &a = small.lights[i], &b = large.lights[i];
      EXPECT_LT(length(b.position - 4.0f * a.position), 1e-3f);
      const float power = a.kind == kLightDirectional ? 1.0f : 16.0f;
      EXPECT_NEAR(b.intensity.x, power * a.intensity.x, 1e-3f * (1.0f + b.intensity.x));
    }
  }
}

TEST(ScaleScene, ScalesVolumesAndViewPoints) {
  Scene scene = make_ball(1.0f);
  scene.materials[0].attenuation_distance = 0.5f;
  scene.view_points.push_back({"own", vec3(1, 2, 3)});
  scale_scene(scene, 0.01f);
  EXPECT_FLOAT_EQ(scene.materials[0].attenuation_distance, 0.005f);
  EXPECT_NEAR(scene.view_points[0].position.z, 0.03f, 1e-7f);
}

// The warning is about what is rendered, not about the numbers in the file.
TEST(ScaleScene, KnowsWhetherTheSceneIsStillTooLarge) {
  Scene scene = make_landscape(10000.0f);
  scene.warnings = {"another", reach_warning(scene)};
  ASSERT_NE(scene.warnings.back(), "");
  Scene smaller = scene, larger = scene;
  scale_scene(smaller, 0.01f);
  EXPECT_EQ(smaller.warnings, std::vector<std::string>{"another"});
  scale_scene(larger, 10.0f);
  ASSERT_EQ(larger.warnings.size(), 2u);
  EXPECT_NE(larger.warnings.back().find("extends 50 km"), std::string::npos) << larger.warnings.back();
}

TEST(ScaleScene, RefusesWhatNoFloatCouldHold) {
  Scene scene = make_landscape(2000.0f);
  EXPECT_THROW(scale_scene(scene, 1e6f), Error);
}

}  // namespace
}  // namespace ods
