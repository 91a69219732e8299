// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The denoiser on a texture: it does not mix the light of owners.
#include <gtest/gtest.h>

#include "ods/denoise/denoise.h"
#include "ods/kernel/camera/camera.h"
#include "tests/support/statistics.h"
#include "tests/support/texels.h"

namespace ods::owners_test {

constexpr int kSize = 96;

// Bands of 7 columns, of one normal and albedo: every third has no owner, and the others alternate between two.
int owner_at(int x) {
  const int band = x / 7;
  return band % 3 == 2 ? -1 : band % 3;
}

StereoCamera bands() {
  TexelRays texels = empty_texels(kSize, kSize);
  for (size_t i = 0; i < texels.rays.size(); i++) {
    texels.owners[i] = owner_at(static_cast<int>(i) % kSize);
    if (texels.owners[i] >= 0) texels.rays[i].direction = vec3(0, 0, -1);
  }
  return camera_of(std::move(texels));
}

// lights: of the two owners, with uniform noise of this size and its variance.
Picture banded(const float (&lights)[2], float noise) {
  Dice dice(5);
  EyeImage eye;
  eye.eye = kMono;
  eye.radiance = eye.variance = eye.normal = eye.albedo = Image(kSize, kSize, 3);
  eye.samples = Image(kSize, kSize, 1);
  for (int y = 0; y < kSize; y++) {
    for (int x = 0; x < kSize; x++) {
      const int owner = owner_at(x);
      *eye.samples.at(x, y) = 16.0f;
      if (owner < 0) continue;
      for (int c = 0; c < 3; c++) {
        eye.radiance.at(x, y)[c] = lights[owner] + dice.between(-noise, noise);
        eye.variance.at(x, y)[c] = 0.01f + noise * noise / 3.0f;
        eye.albedo.at(x, y)[c] = 0.5f;
      }
      eye.normal.at(x, y)[2] = 1.0f;
    }
  }
  return {{eye}, 0.0};
}

template <typename Check>
void each_texel(const Picture& picture, const Check& check) {
  for (int y = 0; y < kSize; y++) {
    for (int x = 0; x < kSize; x++) check(owner_at(x), picture.eyes[0].radiance.at(x, y)[0]);
  }
}

// The two differ by less than their noise is said to be: only the owner tells them apart.
TEST(Owners, AreNotMixed) {
  Picture picture = banded({0.4f, 0.5f}, 0.0f), mixed = picture;
  denoise(picture, bands());
  each_texel(picture, [](int owner, float light) {
    ASSERT_NEAR(light, owner < 0 ? 0.0f : owner == 0 ? 0.4f : 0.5f, 1e-5f);
  });
  StereoCamera flat = bands();
  flat.texel_rays.reset();
  denoise(mixed, flat);
  float change = 0.0f;
  each_texel(mixed, [&](int owner, float light) {
    if (owner >= 0) change = std::max(change, std::abs(light - (owner == 0 ? 0.4f : 0.5f)));
  });
  EXPECT_GT(change, 0.02f) << "else this test shows nothing";
}

TEST(Owners, ABlackOneStaysBlackBesideAWhiteOne) {
  Picture picture = banded({0.0f, 1.0f}, 0.0f);
  picture.eyes[0].radiance.at(7, 50)[0] = 300.0f;  // a firefly at the edge, whose light goes to its own surface
  std::fill_n(picture.eyes[0].variance.at(7, 50), 3, 1e5f);
  denoise(picture, bands());
  EXPECT_NEAR(picture.eyes[0].radiance.at(7, 50)[1], 1.0f, 0.1f);
  double white = 0.0;
  each_texel(picture, [&](int owner, float light) {
    if (owner == 1) {
      white += double{light};
    } else {
      ASSERT_EQ(light, 0.0f);
    }
  });
  EXPECT_GT(white, 0.0);
}

TEST(Owners, AreDenoisedEach) {
  Picture picture = banded({0.3f, 0.9f}, 0.2f);
  denoise(picture, bands());
  double squares = 0.0;
  int count = 0;
  each_texel(picture, [&](int owner, float light) {
    if (owner < 0) return;
    const double off = double{light} - (owner == 0 ? 0.3 : 0.9);
    squares += off * off, count++;
  });
  EXPECT_LT(std::sqrt(squares / count), 0.25 * 0.2 / std::sqrt(3.0));
}

}  // namespace ods::owners_test
