// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Variance and number of samples, beside the picture.
#include <gtest/gtest.h>

#include "ods/render/cpu/render.h"
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
  EXPECT_EQ(picture_bytes(options), 32u * 16 * 14 * sizeof(float));
  const EyeImage eye = render_cpu(scene, StereoCamera{}, options).eyes[0];
  int mixed = 0;
  for (size_t i = 0; i < eye.samples.pixels.size(); i++) {
    ASSERT_EQ(eye.samples.pixels[i], 16.0f);
    const double mean = double{eye.radiance.pixels[3 * i]};
    for (size_t c = 0; c < 3; c++) ASSERT_NEAR(eye.variance.pixels[3 * i + c], mean * (1.0 - mean) / 15.0, 1e-7);
    if (mean > 0.0 && mean < 1.0) mixed++;
  }
  EXPECT_GT(mixed, 10);
}

}  // namespace
}  // namespace ods
