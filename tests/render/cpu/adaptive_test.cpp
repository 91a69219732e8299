// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Samples where they are needed.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ods/render/cpu/render.h"
#include "ods/scene/load/load.h"
#include "tests/support/pictures.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace ods {
namespace {

RenderOptions adaptive(int width, int samples, float noise) {
  RenderOptions options = small_render(width, samples);
  options.eyes = Eyes::kBothEyes;
  options.even_noise = true;
  options.statistics = true;
  options.noise = noise;
  return options;
}

TEST(EvenNoise, RowsHaveSamplesByTheirSolidAngle) {
  Scene scene;
  add_box(scene, vec3(-1.0f), vec3(1.0f), add_material(scene, matte(vec3(0.5f))));
  RenderOptions options = adaptive(128, 64, 0.0f);
  options.height = 256;
  options.bounces = 0;
  const Picture picture = render_cpu(scene, StereoCamera{}, options);
  for (const EyeImage& eye : picture.eyes) {
    EXPECT_EQ(*eye.samples.at(5, 0), 23.0f);
    EXPECT_EQ(*eye.samples.at(5, 128), 64.0f);
    EXPECT_NEAR(*eye.samples.at(77, 64), 64.0 * std::sin(std::numbers::pi * 68.0 / 256.0), 1.0);
  }
}

// One in two thousand samples finds the lamp: blocks without one look clean. If pixels decided on their own stop, the
// mean would be too dark by an eighth, which is six times what these seeds vary by.
TEST(AdaptiveStop, FavoursNoValue) {
  Scene scene;
  add_box(scene, vec3(-1.0f), vec3(1.0f), add_material(scene, matte(vec3(0.8f))));
  Material lamp = matte(vec3(0.0f));
  lamp.emission = vec3(256.0f);
  add_sphere(scene, vec3(0.0f, 0.7f, 0.0f), 0.025f, add_material(scene, lamp), 16);
  Mean stopped, all;
  double taken = 0.0, possible = 0.0;
  for (uint32_t seed = 0; seed < 24; seed++) {
    RenderOptions options = adaptive(32, 192, 0.05f);
    options.bounces = 1;
    options.light_sampling = LightSampling::kBsdfOnly;
    options.seed = seed;
    const Picture a = render_cpu(scene, StereoCamera{}, options);
    options.noise = 0.0f;
    options.seed = seed + 1000;
    const Picture b = render_cpu(scene, StereoCamera{}, options);
    for (size_t eye = 0; eye < 2; eye++) {
      stopped.add(mean_of(a.eyes[eye].radiance).value());
      all.add(mean_of(b.eyes[eye].radiance).value());
      taken += mean_of(a.eyes[eye].samples).value(), possible += mean_of(b.eyes[eye].samples).value();
    }
  }
  EXPECT_LT(taken, 0.8 * possible);
  const double z = (stopped.value() - all.value()) / std::sqrt(stopped.variance() + all.variance());
  EXPECT_LT(std::abs(z), 4.0) << stopped.value() << " instead of " << all.value();
}

TEST(AdaptiveStop, TheSameBitsWhateverTheThreads) {
  const Scene scene = load_scene("toys", {});
  RenderOptions options = adaptive(64, 128, 0.1f);
  options.threads = 1;
  const uint64_t one = digest(render_cpu(scene, StereoCamera{}, options));
  options.threads = 3;
  options.last_tile_first = true;
  EXPECT_EQ(one, digest(render_cpu(scene, StereoCamera{}, options)));
}

TEST(AdaptiveStop, LessNoiseTakesMoreSamples) {
  const Scene scene = load_scene("toys", {});
  double last = 0.0;
  for (const float noise : {0.4f, 0.1f, 0.03f}) {
    const Picture picture = render_cpu(scene, StereoCamera{}, adaptive(64, 512, noise));
    double samples = 0.0;
    for (const EyeImage& eye : picture.eyes) {
      for (const float count : eye.samples.pixels) samples += double{count};
    }
    EXPECT_GT(samples, last);
    last = samples;
  }
}

TEST(TimeLimit, EndsAPictureThatWouldTakeForever) {
  const Scene scene = load_scene("toys", {});
  RenderOptions options = adaptive(64, 1 << 20, 0.0f);
  options.time_limit = 0.5;
  const Picture picture = render_cpu(scene, StereoCamera{}, options);
  EXPECT_GE(*picture.eyes[0].samples.at(0, 16), 1.0f);
  EXPECT_LT(*picture.eyes[0].samples.at(0, 16), 1e5f);
}

}  // namespace
}  // namespace ods
