// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Whole scenes whose mean radiance other renderers agree on, in a white sky of radiance 1.
#include <gtest/gtest.h>

#include <filesystem>

#include "ods/render/cpu/render.h"
#include "ods/scene/load/load.h"
#include "tests/support/pictures.h"
#include "tests/support/places.h"

namespace ods {
namespace {

void expect_mean(const std::string& name, vec3 position, int samples, double known) {
  const std::filesystem::path path = std::filesystem::path(shared_scenes()) / name;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "skipped: " << name << " is not in ../shared/scenes";
  Scene scene = load_scene(path.string());
  scene.environment = {vec3(1.0f), 0, 0, {}};
  StereoCamera camera;
  camera.position = position;
  RenderOptions options = small_render(256, samples);
  options.eyes = Eyes::kBothEyes;
  options.bounces = 8;
  for (const EyeImage& eye : render_cpu(scene, camera, options).eyes) {
    double sum = 0.0;
    for (float value : eye.radiance.pixels) sum += double{value};
    EXPECT_NEAR(sum / static_cast<double>(eye.radiance.pixels.size()), known, 0.01 * known) << eye.eye;
  }
}

TEST(SharedScenes, AtriumIsAsBrightAsElsewhere) {
  expect_mean("atrium.glb", vec3(0.0f, 1.6f, 0.0f), 16, 0.2740);
}

TEST(SharedScenes, DamagedHelmetIsAsBrightAsElsewhere) {
  expect_mean("DamagedHelmet.glb", vec3(0.0f, 0.0f, 1.5f), 16, 0.9645);
}

}  // namespace
}  // namespace ods
