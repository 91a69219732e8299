// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The layers beside the radiance: features, variance and number of samples.
#include <gtest/gtest.h>

#include <array>

#include "ods/render/cpu/render.h"
#include "ods/render/render_target.h"
#include "tests/support/pictures.h"
#include "tests/support/scenes.h"

namespace ods {
namespace {

// Samples of an unlit white object before nothing are 1 or 0: k of n have the mean k/n and the variance of the mean
// k/n (1 - k/n) / (n - 1).
TEST(Statistics, OfSamplesThatAreOneOrZero) {
  Scene scene;
  Material white = default_material();
  white.unlit = 1;
  add_sphere(scene, vec3(0.0f, 0.0f, -2.0f), 1.0f, add_material(scene, white), 32);
  RenderOptions options = small_render(32, 16);
  options.statistics = true;
  options.height = 16;
  EXPECT_EQ(picture_bytes(options), 32u * 16 * (14 * sizeof(float) + 80));
  const EyeImage eye = render_cpu(scene, StereoCamera{}, options).eyes[0];
  int mixed = 0;
  for (size_t i = 0; i < eye.samples.pixels.size(); i++) {
    ASSERT_EQ(eye.samples.pixels[i], 16.0f);
    const double mean = double{eye.radiance.pixels[3 * i]};
    for (size_t c = 0; c < 3; c++) ASSERT_NEAR(eye.variance.pixels[3 * i + c], mean * (1.0 - mean) / 15.0, 3e-7);
    if (mean > 0.0 && mean < 1.0) mixed++;
  }
  EXPECT_GT(mixed, 10);
}

// Layers that a file cannot store do not take memory, and do not change anything else.
TEST(Layers, CanBeLeftOut) {
  Scene scene;
  add_box(scene, vec3(-1.0f), vec3(1.0f), add_material(scene, matte(vec3(0.5f))));
  RenderOptions options = small_render(32, 2);
  options.height = 16;
  const Picture whole = render_cpu(scene, StereoCamera{}, options);
  EXPECT_EQ(picture_bytes(options), 32u * 16 * (10 * sizeof(float) + 56));
  options.layers = false;
  const Picture bare = render_cpu(scene, StereoCamera{}, options);
  EXPECT_EQ(picture_bytes(options), 32u * 16 * (3 * sizeof(float) + 28));
  EXPECT_EQ(bare.eyes[0].radiance.pixels, whole.eyes[0].radiance.pixels);
  EXPECT_TRUE(bare.eyes[0].depth.pixels.empty() && bare.eyes[0].normal.pixels.empty());
}

// So denoisers see the edges in a mirror. Its depth is its own: the eyes meet it there.
TEST(Layers, MirrorsShowWhatTheyReflect) {
  Scene scene;
  Material mirror = default_material();
  mirror.base_color = vec4(0.5f, 1.0f, 1.0f, 1.0f);
  mirror.metallic = 1.0f;
  mirror.roughness = 0.0f;
  const auto plane = [&](float y, int material) {
    add_rectangle(scene, vec3(-300, y, 300), vec3(600, 0, 0), vec3(0, 0, -600), material);
  };
  plane(-1.0f, add_material(scene, mirror));
  const auto lowest = [&] {
    const EyeImage eye = render_cpu(scene, StereoCamera{}, small_render(32, 4)).eyes[0];
    const float* n = eye.normal.at(16, 15);
    const float* a = eye.albedo.at(16, 15);
    return std::array{eye.depth.at(16, 15)[0], n[1], a[0], a[1]};
  };
  const auto sky = lowest();
  EXPECT_NEAR(sky[0], 1.0f, 0.02f);
  EXPECT_EQ(sky[1], 0.0f);
  EXPECT_EQ(sky[2], 0.0f);
  Material red = matte(vec3(0.8f, 0.2f, 0.2f));
  red.double_sided = 1;
  plane(2.0f, add_material(scene, red));
  const auto ceiling = lowest();
  EXPECT_NEAR(ceiling[0], 1.0f, 0.02f);
  EXPECT_NEAR(ceiling[1], -1.0f, 1e-3f);
  EXPECT_NEAR(ceiling[2], 0.4f, 1e-3f);
  EXPECT_NEAR(ceiling[3], 0.2f, 1e-3f);
}

}  // namespace
}  // namespace ods
