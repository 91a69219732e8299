// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// RenderOptions::clamp.
#include <gtest/gtest.h>

#include "ods/render/cpu/render.h"
#include "ods/scene/load/load.h"
#include "tests/support/pictures.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace ods {
namespace {

// Light that has met fewer than two surfaces stays: e (1 + 1), then the clamp for each of the other three.
TEST(Render, ClampLimitsIndirectLight) {
  Scene scene;
  Material wall = matte(vec3(1.0f));
  wall.emission = vec3(0.7f);
  add_box(scene, vec3(-1.0f, -2.0f, -1.5f), vec3(2.0f, 1.0f, 1.0f), add_material(scene, wall));
  RenderOptions options = small_render(32, 4);
  options.bounces = 4;
  options.light_sampling = LightSampling::kBsdfOnly;
  for (const auto& [clamp, light] : {std::pair{0.0f, 5 * 0.7f}, {0.8f, 5 * 0.7f}, {0.2f, 2 * 0.7f + 3 * 0.2f}}) {
    options.clamp = clamp;
    const Picture picture = render_cpu(scene, StereoCamera{}, options);
    for (const float value : picture.eyes[0].radiance.pixels) {
      ASSERT_NEAR(value, light, 1e-4f) << clamp;
    }
  }
}

// The light found by shadow rays is clamped, too, and both eyes agree.
TEST(Render, ClampTakesLightFromBothEyesAlike) {
  const Scene scene = load_scene("room");
  RenderOptions options = small_render(48, 64);
  options.eyes = Eyes::kBothEyes;
  const auto light = [&](float clamp, bool shares) {
    options.clamp = clamp;
    options.share_paths = shares;
    const Picture picture = render_cpu(scene, StereoCamera{}, options);
    return mean_of(picture.eyes[0].radiance).value() + mean_of(picture.eyes[1].radiance).value();
  };
  EXPECT_LT(light(0.05f, false), 0.97 * light(0.0f, false));
  EXPECT_NEAR(light(0.05f, true), light(0.05f, false), 0.03 * light(0.05f, false));
}

}  // namespace
}  // namespace ods
