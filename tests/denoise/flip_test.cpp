// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The judge of the denoiser.
#include "tests/support/flip.h"

#include <gtest/gtest.h>

namespace ods {
namespace {

Image filled(float r, float g, float b) {
  Image image(64, 48, 3);
  for (size_t i = 0; i < image.pixels.size(); i += 3) {
    image.pixels[i] = r, image.pixels[i + 1] = g, image.pixels[i + 2] = b;
  }
  return image;
}

// Plain pictures have no edges: what is left is the curve of colours. It is 1 between green and blue, by definition,
// and white from black, 100 in L*, is a known share of that.
TEST(Flip, PlainPicturesDifferByTheirColours) {
  EXPECT_NEAR(flip_error(filled(0.0f, 1.0f, 0.0f), filled(0.0f, 0.0f, 1.0f)), 1.0, 1e-3);
  EXPECT_EQ(flip_error(filled(0.3f, 0.4f, 0.5f), filled(0.3f, 0.4f, 0.5f)), 0.0);
  const float maximum =
      std::pow(flip::distance_of(flip::perceived(vec3(0, 1, 0)), flip::perceived(vec3(0, 0, 1))), 0.7f);
  const float white = std::pow(100.0f, 0.7f) / maximum;
  EXPECT_NEAR(flip_error(filled(0, 0, 0), filled(1, 1, 1)), 0.95f + (white - 0.4f) / 0.6f * 0.05f, 2e-3f);
}

// From far away a fine chequer looks grey, a coarse one does not.
TEST(Flip, DetailThatNobodySeesIsNoError) {
  const auto chequer = [](int size) {
    Image image = filled(0.25f, 0.25f, 0.25f);
    for (int y = 0; y < 48; y++) {
      for (int x = 0; x < 64; x++) {
        const float light = (x / size + y / size) % 2 == 0 ? 0.24f : 0.26f;
        for (int c = 0; c < 3; c++) image.at(x, y)[c] = light;
      }
    }
    return image;
  };
  const Image grey = filled(0.25f, 0.25f, 0.25f);
  EXPECT_LT(flip_error(grey, chequer(1)), 0.3 * flip_error(grey, chequer(16)));
}

}  // namespace
}  // namespace ods
