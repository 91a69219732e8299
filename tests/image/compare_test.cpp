// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "ods/base/error.h"

namespace ods {
namespace {

std::vector<Image> noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Image> eyes(2, Image(width, height, 3));
  for (Image& eye : eyes) {
    for (float& value : eye.pixels) value = static_cast<float>(random() % 4096) / 4096.0f;
  }
  return eyes;
}

TEST(Compare, EqualPicturesHaveNoError) {
  const std::vector<Image> a = noise(16, 8, 1);
  const Comparison same = compare_eyes(a, a);
  ASSERT_EQ(same.eyes.size(), 2u);
  for (const Errors& errors : {same.eyes[0], same.eyes[1], same.whole}) {
    EXPECT_EQ(errors.rmse, 0.0);
    EXPECT_EQ(errors.psnr, std::numeric_limits<double>::infinity());
    EXPECT_EQ(errors.ws_psnr, std::numeric_limits<double>::infinity());
    EXPECT_EQ(errors.largest.error, 0.0);
    EXPECT_EQ(errors.not_finite, 0);
  }
}

TEST(Compare, AConstantOffsetHasAClosedForm) {
  const std::vector<Image> a = noise(16, 8, 1);
  std::vector<Image> b = a;
  for (float& value : b[1].pixels) value += 0.125f;
  const Comparison offset = compare_eyes(a, b);
  EXPECT_EQ(offset.eyes[0].rmse, 0.0);
  EXPECT_DOUBLE_EQ(offset.eyes[1].rmse, 0.125);
  EXPECT_NEAR(offset.eyes[1].psnr, 20.0 * std::log10(8.0), 1e-12);
  EXPECT_NEAR(offset.eyes[1].ws_psnr, offset.eyes[1].psnr, 1e-12) << "an even error weighs the same everywhere";
  EXPECT_NEAR(offset.whole.rmse, 0.125 / std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(offset.whole.psnr, 20.0 * std::log10(8.0) + 10.0 * std::log10(2.0), 1e-12);
}

// One row wrong: the weighted mean is that row's share of the sphere, cosine over the sum of cosines.
TEST(Compare, TheSphereWeighsPolesLessThanTheHorizon) {
  const int height = 8;
  double weights = 0.0;
  for (int y = 0; y < height; y++) weights += std::cos((y + 0.5 - 4.0) * std::acos(-1.0) / height);
  for (int y : {0, 3, 7}) {
    const std::vector<Image> a(1, Image(16, height, 3));
    std::vector<Image> b = a;
    for (int x = 0; x < 16; x++) b[0].at(x, y)[0] = b[0].at(x, y)[1] = b[0].at(x, y)[2] = 0.5f;
    const Errors errors = compare_eyes(a, b).whole;
    EXPECT_NEAR(errors.psnr, -10.0 * std::log10(0.25 / height), 1e-12);
    const double share = std::cos((y + 0.5 - 4.0) * std::acos(-1.0) / height) / weights;
    EXPECT_NEAR(errors.ws_psnr, -10.0 * std::log10(0.25 * share), 1e-9) << "row " << y;
    EXPECT_EQ(errors.ws_psnr > errors.psnr, y != 3) << "row " << y;
  }
}

TEST(Compare, FindsThePlantedPixel) {
  const std::vector<Image> a = noise(16, 8, 2);
  std::vector<Image> b = a;
  for (float& value : b[0].pixels) value += 0.0625f;
  b[1].at(11, 5)[2] -= 0.25f;
  const Comparison comparison = compare_eyes(a, b);
  const LargestError& largest = comparison.whole.largest;
  EXPECT_EQ(largest.eye, 1);
  EXPECT_EQ(largest.x, 11);
  EXPECT_EQ(largest.y, 5);
  EXPECT_EQ(largest.channel, 2);
  EXPECT_NEAR(largest.error, 0.25, 1e-7);
  EXPECT_EQ(comparison.eyes[0].largest.eye, 0);
  EXPECT_EQ(comparison.eyes[0].largest.error, 0.0625);
  EXPECT_NEAR(difference(a[1], b[1]).at(11, 5)[2], -0.25f, 1e-7f);
  EXPECT_EQ(difference(a[1], b[1]).at(10, 5)[2], 0.0f);
}

TEST(Compare, PixelsThatAreNoNumbersAreCountedAndLeftOut) {
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()};
  const std::vector<Image> a = noise(16, 8, 3);
  std::vector<Image> b = a;
  b[0].at(1, 1)[0] = bad[0];
  b[0].at(2, 1)[1] = bad[1];
  const Comparison comparison = compare_eyes(a, b);
  EXPECT_EQ(comparison.eyes[0].not_finite, 2);
  EXPECT_EQ(comparison.eyes[1].not_finite, 0);
  EXPECT_EQ(comparison.whole.not_finite, 2);
  EXPECT_EQ(comparison.whole.rmse, 0.0);
  EXPECT_EQ(difference(a[0], b[0]).at(1, 1)[0], 0.0f);

  const std::vector<Image> nothing(1, [&] {
    Image image(2, 1, 3);
    for (float& value : image.pixels) value = bad[0];
    return image;
  }());
  EXPECT_TRUE(std::isnan(compare_eyes(nothing, nothing).whole.rmse)) << "nothing compared is not equal";
}

TEST(Compare, PicturesOfDifferentFormAreRefused) {
  std::mt19937 random(5);
  for (int i = 0; i < 20; i++) {
    const auto side = [&] { return static_cast<int>(1 + random() % 7); };
    const std::vector<Image> a(1 + random() % 2, Image(side(), side(), side()));
    const std::vector<Image> b(1 + random() % 2, Image(side(), side(), side()));
    const bool same = a.size() == b.size() && a[0].width == b[0].width && a[0].height == b[0].height &&
                      a[0].channels == b[0].channels;
    if (same) continue;
    try {
      compare_eyes(a, b, {"'a.png'", "'b.png'"});
      FAIL() << "compared";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      const std::string what = error.what();
      EXPECT_EQ(what.find('\n'), std::string::npos);
      EXPECT_TRUE(what.starts_with("'a.png' has ") && what.find(", 'b.png' has ") != std::string::npos) << what;
    }
  }
}

TEST(ZTest, NoiseOfItsVariancePassesAndABiasDoesNot) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  const std::vector<Image> flat(1, Image(128, 64, 3));
  std::vector<Image> a = flat, b = flat, variance_a = flat, variance_b = flat;
  for (size_t i = 0; i < flat[0].pixels.size(); i++) {
    variance_a[0].pixels[i] = 0.01f;
    variance_b[0].pixels[i] = 0.03f;
    a[0].pixels[i] = 0.1f * normal(random);
    b[0].pixels[i] = std::sqrt(0.03f) * normal(random);
  }
  // 24576 values: four standard errors of the mean, the rms and the share.
  const ZTest noise = z_test(a, b, variance_a, variance_b);
  EXPECT_EQ(noise.values, 24576);
  EXPECT_NEAR(noise.mean, 0.0, 4.0 / 156.8);
  EXPECT_NEAR(noise.rms, 1.0, 4.0 / 221.7);
  EXPECT_NEAR(noise.beyond_3, 0.0027, 4.0 * 0.052 / 156.8);
  EXPECT_EQ(noise.sure_differences, 0);

  for (float& value : b[0].pixels) value += 0.1f;  // half a standard deviation of the difference
  EXPECT_NEAR(z_test(a, b, variance_a, variance_b).mean, 0.5, 4.0 / 156.8);
}

TEST(ZTest, WithoutVarianceADifferenceIsSure) {
  const std::vector<Image> zero(1, Image(2, 1, 3));
  std::vector<Image> b = zero;
  b[0].pixels[4] = 1e-6f;
  const ZTest test = z_test(zero, b, zero, zero);
  EXPECT_EQ(test.values, 0);
  EXPECT_EQ(test.sure_differences, 1);
  EXPECT_EQ(test.rms, 0.0);
}

}  // namespace
}  // namespace ods
