// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/sampling_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ods/camera/projection.h"
#include "ods/kernel/camera/projection.h"
#include "ods/render/render_target.h"
#include "tests/support/texels.h"

namespace ods {
namespace {

RenderOptions options_of(const StereoCamera& camera, int width, int samples) {
  RenderOptions options;
  options.width = width;
  options.samples = samples;
  return with_height(options, camera);
}

TEST(SamplingPlan, LatLongSharesFollowTheCosine) {
  const StereoCamera camera;
  const RenderOptions options = options_of(camera, 1024, 64);
  const SamplingPlan plan = make_plan(camera, options);
  double minimum = 1.0;
  const int rows = options.height / kBlockSize;
  for (int row = 0; row < rows; row++) {
    const auto cosine = [&](int i) { return std::sin(std::numbers::pi * (i + 0.5) / rows); };
    const double share = std::max(cosine(row) / cosine(rows / 2), 0.35);
    for (int column : {0, plan.columns / 3, plan.columns - 1}) {
      const double found = double{plan.share[static_cast<size_t>(row * plan.columns + column)]};
      EXPECT_NEAR(found, share, 1e-5) << row;
      minimum = std::min(minimum, found);
    }
  }
  EXPECT_NEAR(minimum, 0.35, 1e-6);
}

// Equal areas have equal solid angles: every block has all samples.
TEST(SamplingPlan, EquisolidFisheyesAreEven) {
  StereoCamera camera;
  camera.projection.kind = kFisheyeEquisolid;
  const SamplingPlan plan = make_plan(camera, options_of(camera, 512, 64));
  for (const float share : plan.share) EXPECT_NEAR(share, 1.0f, 2e-3f);
}

TEST(SamplingPlan, EveryPixelHasASampleAndTheLargestHaveAll) {
  for (const NamedProjection& named : named_projections()) {
    StereoCamera camera;
    camera.projection = named.setting;
    const SamplingPlan plan = make_plan(camera, options_of(camera, 240, 64));
    int maximum = 0;
    for (size_t block = 0; block < plan.share.size(); block++) {
      ASSERT_EQ(samples_of(plan, block, 0), 0) << named.name;
      ASSERT_GE(samples_of(plan, block, 1), 1) << named.name;
      ASSERT_LE(samples_of(plan, block, 64), 64) << named.name;
      maximum = std::max(maximum, samples_of(plan, block, 64));
    }
    EXPECT_EQ(maximum, 64) << named.name;
  }
}

TEST(SamplingPlan, CanBeUniform) {
  RenderOptions options = options_of(StereoCamera{}, 256, 64);
  options.even_noise = false;
  for (const float share : make_plan(StereoCamera{}, options).share) EXPECT_EQ(share, 1.0f);
}

// A block of 64 grey pixels of which one class has noise: the other class continues, its own stops.
TEST(SamplingPlan, EachClassIsJudgedByTheOther) {
  RenderOptions options = options_of(StereoCamera{}, 16, 64);
  options.noise = 0.01f;
  options.even_noise = false;
  options.eyes = Eyes::kMonoEye;
  PictureSamples samples = no_samples(options);
  samples.done = 16;
  EyeSamples& eye = samples.eyes[0];
  for (int y = 0; y < 8; y++) {
    for (int x = 0; x < 16; x++) {
      const size_t pixel = static_cast<size_t>(y * 16 + x);
      eye.count[pixel] = 16;
      const bool noisy = x < 8 && class_of(x, y) == 0;
      for (size_t c = 0; c < 3; c++) {
        // Eight samples of 0 and eight of 1, or sixteen of 1/2.
        eye.light[3 * pixel + c] = static_cast<int64_t>(8 * kLightUnit);
        eye.squares[3 * pixel + c] = noisy ? 8.0 : 4.0;
      }
    }
  }
  const SamplingPlan plan = make_plan(StereoCamera{}, options);
  // Variance 1/4 of a sample, 1/60 of the mean; noise 3 sqrt(1/60) / 1.5 against 0.05.
  const double excess = std::pow(3.0 * std::sqrt(1.0 / 60.0) / (1e-4 + 1.5) / 0.05, 2.0) - 1.0;
  const double more = judge_noise(plan, options, samples);
  EXPECT_EQ(samples.noisy[0], 2);
  EXPECT_EQ(samples.noisy[1], 0);
  EXPECT_NEAR(more, std::min(0.5 * excess, 3.0) / 2.0, 1e-3);
}

// A texture's block of which only some texels have rays, all with the same noise: whatever number they are, and even if
// all are in one class, they are as noisy as a full block. A block without rays has no noise.
TEST(SamplingPlan, EmptyTexelsDoNotCount) {
  const auto more_with = [](int count) {
    TexelRays texels = empty_texels(8, 8);
    RenderOptions options = with_texels({}, 8, 8);
    options.samples = kMaxSamples, options.noise = 0.01f;
    PictureSamples samples = no_samples(options);
    samples.done = 16;
    EyeSamples& eye = samples.eyes[0];
    for (size_t i = 0; i < 64; i++) {
      eye.count[i] = 16;
      if (static_cast<int>(i) >= count) continue;
      texels.rays[i].direction = vec3(0, 0, -1);
      for (size_t c = 3 * i; c < 3 * i + 3; c++) {
        eye.light[c] = static_cast<int64_t>(8 * kLightUnit), eye.squares[c] = 8.0;
      }
    }
    return judge_noise(make_plan(camera_of(std::move(texels)), options), options, samples);
  };
  const double full = more_with(64);
  EXPECT_GT(full, 1.0);
  for (const int count : {1, 2, 3, 9, 40}) EXPECT_NEAR(more_with(count), full, 1e-9 * full) << count;
  EXPECT_EQ(more_with(0), 0.0);
}

TEST(SamplingPlan, TexelsHaveEqualShares) {
  const SamplingPlan plan = make_plan(camera_of(empty_texels(64, 32)), with_texels({}, 64, 32));
  for (const float share : plan.share) EXPECT_EQ(share, 1.0f);
}

// Noise is judged as it is seen: a sixteenth of the light, shown with four stops, is as noisy as all of it.
TEST(SamplingPlan, NoiseIsJudgedAtTheExposure) {
  RenderOptions options = options_of(StereoCamera{}, 8, 64);
  options.height = 8;
  options.even_noise = false;
  options.eyes = Eyes::kMonoEye;
  options.noise = 0.01f;
  const SamplingPlan plan = make_plan(StereoCamera{}, options);
  const auto more_for = [&](double light, float stops) {
    PictureSamples samples = no_samples(options);
    samples.done = 16;
    EyeSamples& eye = samples.eyes[0];
    for (size_t pixel = 0; pixel < 64; pixel++) {
      eye.count[pixel] = 16;
      for (size_t c = 0; c < 3; c++) {
        // Eight samples of 0 and eight of this light.
        eye.light[3 * pixel + c] = static_cast<int64_t>(8 * light * kLightUnit);
        eye.squares[3 * pixel + c] = 8 * light * light;
      }
    }
    options.noise_exposure = stops;
    return judge_noise(plan, options, samples);
  };
  options.samples = kMaxSamples;  // so that nothing limits what more it takes
  EXPECT_NEAR(more_for(1.0 / 16.0, 4.0f) / more_for(1.0, 0.0f), 1.0, 1e-6);
  EXPECT_LT(more_for(1.0 / 16.0, 0.0f), 0.2 * more_for(1.0, 0.0f));
}

// One class has stopped with 16 samples of variance 1/4. Nothing makes it cleaner, but with 64 it would be clean
// enough: so the other class, which has 64, stops as well.
TEST(SamplingPlan, AStoppedClassIsJudgedAsIfItHadGoneOn) {
  RenderOptions options = options_of(StereoCamera{}, 8, 1024);
  options.height = 8;
  options.even_noise = false;
  options.eyes = Eyes::kMonoEye;
  const double deviation = std::sqrt(1.0 / 60.0);  // of the mean of 16
  for (const auto& [wanted, noisy] : {std::pair{0.6, 0}, std::pair{0.4, 2}}) {
    options.noise = static_cast<float>(wanted * 3.0 * deviation / 1.5 / 5.0);
    PictureSamples samples = no_samples(options);
    samples.done = 64;
    samples.noisy[0] = 2;
    EyeSamples& eye = samples.eyes[0];
    for (size_t pixel = 0; pixel < 64; pixel++) {
      const uint32_t count = class_of(static_cast<int>(pixel % 8), static_cast<int>(pixel / 8)) == 0 ? 16 : 64;
      eye.count[pixel] = count;
      for (size_t c = 0; c < 3; c++) {
        eye.light[3 * pixel + c] = static_cast<int64_t>(count / 2 * kLightUnit);
        eye.squares[3 * pixel + c] = count / 2;
      }
    }
    judge_noise(make_plan(StereoCamera{}, options), options, samples);
    EXPECT_EQ(samples.noisy[0], noisy) << wanted;
  }
}

// Blocks of 16 samples have stopped in the dark, while others went on to 256. Shown with six stops they are noisy, and
// would be clean with 256 samples: until they have as many, they are sampled.
TEST(SamplingPlan, AStoppedBlockIsJudgedAgainAtAnotherExposure) {
  RenderOptions options = options_of(StereoCamera{}, 8, 1024);
  options.height = 8;
  options.even_noise = false;
  options.eyes = Eyes::kMonoEye;
  options.noise = 0.02f;
  const SamplingPlan plan = make_plan(StereoCamera{}, options);
  PictureSamples samples = no_samples(options);
  const auto take = [&](uint32_t count) {
    EyeSamples& eye = samples.eyes[0];
    for (size_t pixel = 0; pixel < 64; pixel++) {
      eye.count[pixel] = count;
      for (size_t c = 0; c < 3; c++) {
        // Half of them are 0 and half are 1/64.
        eye.light[3 * pixel + c] = static_cast<int64_t>(count / 2 * kLightUnit / 64.0);
        eye.squares[3 * pixel + c] = count / 2 / 4096.0;
      }
    }
    judge_noise(plan, options, samples);
  };
  samples.done = 16;
  take(16);
  EXPECT_EQ(samples.noisy[0], 0);
  samples.done = 256;
  take(16);
  EXPECT_EQ(samples.noisy[0], 0) << "at the same exposure it stays";
  options.noise_exposure = 6.0f;
  take(16);
  EXPECT_EQ(samples.noisy[0], kBothClasses);
  take(32);
  EXPECT_EQ(samples.noisy[0], kBothClasses) << "by the samples that it has, not by those of the picture";
  take(256);
  EXPECT_EQ(samples.noisy[0], 0);
}

}  // namespace
}  // namespace ods
