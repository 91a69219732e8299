// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Open Image Denoise is in no distribution that this project builds on: fake_oidn.cpp stands in for it.
#include "ods/denoise/oidn.h"

#include <gtest/gtest.h>

#include "ods/base/error.h"
#include "ods/camera/projection.h"

// fake_oidn.cpp
extern "C" {
void fake_reset(bool failing);
const std::vector<float>& fake_scales();
const std::vector<std::vector<float>>& fake_colors();
const std::vector<size_t>& fake_widths();
size_t fake_with_features();
}

namespace ods {
namespace {

class Oidn : public ::testing::Test {
 protected:
  void SetUp() override { fake_reset(false); }
};

// The radiance encodes the place of a pixel: eye, column, row.
Picture numbered(int width, int height, bool features) {
  Picture picture;
  for (const int eye : {kLeft, kRight}) {
    EyeImage image{eye, Image(width, height, 3), {}, {}, {}, {}};
    for (int y = 0; y < height; y++) {
      for (int x = 0; x < width; x++) {
        const float color[] = {1.0f + static_cast<float>(eye), static_cast<float>(x), static_cast<float>(y)};
        std::copy_n(color, 3, image.radiance.at(x, y));
      }
    }
    if (features) image.albedo = image.normal = Image(width, height, 3);
    picture.eyes.push_back(std::move(image));
  }
  return picture;
}

TEST_F(Oidn, EveryPixelIsDenoisedOnceAtOneScale) {
  for (const char* name : {"lat-long", "cube-3x2", "fisheye"}) {
    fake_reset(false);
    StereoCamera camera;
    camera.projection = find_projection(name)->setting;
    const int width = 192, height = natural_height(camera.projection, width);
    Picture picture = numbered(width, height, true);
    const Picture before = picture;
    denoise_with_oidn(picture, camera);
    for (size_t eye = 0; eye < 2; eye++) {
      for (size_t i = 0; i < picture.eyes[eye].radiance.pixels.size(); i++) {
        ASSERT_EQ(picture.eyes[eye].radiance.pixels[i], 0.5f * before.eyes[eye].radiance.pixels[i]) << name << i;
      }
    }
    EXPECT_EQ(fake_scales().size(), name == std::string("cube-3x2") ? 12u : 2u) << name;
    for (const float scale : fake_scales()) EXPECT_EQ(scale, fake_scales()[0]) << name;
    EXPECT_GT(fake_scales()[0], 0.0f);
    EXPECT_EQ(fake_with_features(), fake_scales().size()) << name;
  }
}

// Left of the left edge is the right edge; above the pole of a stereo picture is the other eye's picture, half a turn
// away.
TEST_F(Oidn, MarginsShowWhatTheWorldHasThere) {
  Picture picture = numbered(256, 128, false);
  denoise_with_oidn(picture, StereoCamera());
  ASSERT_EQ(fake_colors().size(), 2u);
  ASSERT_EQ(fake_widths()[0], 256u + 2 * 64);
  const auto at = [&](int x, int y) {
    return &fake_colors()[0][3 * (size_t(y + 64) * fake_widths()[0] + size_t(x + 64))];
  };
  EXPECT_EQ(at(0, 5)[1], 0.0f);
  EXPECT_EQ(at(-1, 5)[1], 255.0f);
  EXPECT_EQ(at(256, 5)[1], 0.0f);
  EXPECT_EQ(at(10, -1)[0], 2.0f);
  EXPECT_EQ(at(10, -1)[1], 138.0f);
  EXPECT_EQ(at(10, -1)[2], 0.0f);
  EXPECT_EQ(fake_with_features(), 0u);
}

TEST_F(Oidn, FailuresAreErrors) {
  fake_reset(true);
  Picture picture = numbered(16, 8, false);
  const Picture before = picture;
  try {
    denoise_with_oidn(picture, StereoCamera());
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), std::string("Open Image Denoise: no more of this"));
  }
  EXPECT_EQ(picture.eyes[0].radiance.pixels, before.eyes[0].radiance.pixels);
}

}  // namespace
}  // namespace ods
