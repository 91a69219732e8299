// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/picture_samples.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ods {
namespace {

// One pixel per eye, both eyes from shared paths: 16 samples of its own, half 0 and half 1, each of which counts by
// half. The other eye's paths brought as much, and `bright` besides.
PictureSamples one_pixel(double bright) {
  RenderOptions options;
  options.width = options.height = 1;
  options.samples = 16;
  options.statistics = true;
  PictureSamples samples = no_samples(options);
  EyeSamples& eye = samples.eyes[0];
  eye.count[0] = 16;
  eye.weights[0] = static_cast<uint32_t>(0.5f * 16.0f * kWeightUnit);
  for (size_t c = 0; c < 3; c++) {
    eye.squares[c] = 8.0;
    eye.alone[c] = static_cast<int64_t>(8.0 * kLightUnit);
    eye.light[c] = static_cast<int64_t>((8.0 + bright) * kLightUnit);
  }
  return samples;
}

constexpr double kOwnVariance = 4.0 / 15.0 * 0.5 / 16.0;  // of the mean of these samples

TEST(PictureSamples, LightThatBothWaysAgreeOnVariesAsItsOwnSamplesDo) {
  EXPECT_NEAR(variance_of_mean(one_pixel(0.0).eyes[0], 0).x, kOwnVariance, 1e-5);
  // Almost three standard deviations of the mean.
  EXPECT_NEAR(variance_of_mean(one_pixel(16.0 * 2.99 * std::sqrt(kOwnVariance)).eyes[0], 0).y, kOwnVariance, 1e-5);
}

// One bright sample has a standard deviation as large as what it adds to the mean, whichever eye traced it.
TEST(PictureSamples, ABrightSampleOfTheOtherEyeCounts) {
  const vec3 variance = variance_of_mean(one_pixel(16.0 * 100.0).eyes[0], 0);
  for (int c = 0; c < 3; c++) EXPECT_NEAR(std::sqrt(variance[c]), 100.0, 0.1);
}

TEST(PictureSamples, ABrightSampleOfTheOtherEyeCountsAmongEqualOnes) {
  PictureSamples samples = one_pixel(16.0 * 3.0);
  for (double& squares : samples.eyes[0].squares) squares = 4.0;  // all samples are 1/2
  EXPECT_NEAR(variance_of_mean(samples.eyes[0], 0).x, 9.0, 1e-3);
}

// An eye lacks the light that it has given away: that is not noise.
TEST(PictureSamples, InTheMiddleOfAPassEachEyeIsAlone) {
  PictureSamples samples = one_pixel(-8.0);
  samples.blocks_done = 1;
  RenderOptions options;
  options.width = options.height = 1;
  options.samples = 16;
  options.statistics = true;
  const Picture picture = develop(samples, options);
  EXPECT_EQ(picture.eyes[0].radiance.pixels[0], 0.5f);
  EXPECT_NEAR(picture.eyes[0].variance.pixels[0], kOwnVariance, 1e-5);
}

}  // namespace
}  // namespace ods
