// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/reduced_textures.h"

#include <gtest/gtest.h>

namespace ods {
namespace {

// Columns of black and white, half of them opaque.
Scene striped_scene(int width, int height, int srgb) {
  Scene scene;
  scene.textures.push_back({0, width, height, kWrapRepeat, kWrapClamp, srgb, 0, kTexelBytes});
  for (int i = 0; i < width * height; i++) scene.texels.push_back(i % 2 == 0 ? 0xff000000u : 0x00ffffffu);
  return scene;
}

TEST(ReducedTextures, AreAnEighthUnlessThatIsSmall) {
  struct Known {
    int width, height, reduced_width, reduced_height;
  };
  for (const Known& known : {Known{1, 1, 1, 1}, Known{256, 256, 256, 256}, Known{512, 512, 256, 256},
                             Known{4096, 4096, 512, 512}, Known{1000, 700, 250, 175}, Known{70000, 3, 35000, 1}}) {
    Scene scene = striped_scene(known.width, known.height, 0);
    reduce_textures(scene);
    ASSERT_EQ(scene.reduced_textures.size(), 1u);
    EXPECT_EQ(scene.reduced_textures[0].width, known.reduced_width);
    EXPECT_EQ(scene.reduced_textures[0].height, known.reduced_height);
    EXPECT_EQ(scene.reduced_textures[0].wrap_v, kWrapClamp);
    EXPECT_EQ(scene.reduced_texels.size(), static_cast<size_t>(known.reduced_width * known.reduced_height));
  }
}

// Half of white is 0.5 in linear light, which sRGB writes as 188, and what is not a colour as 128.
TEST(ReducedTextures, AreMeansOfLinearLight) {
  for (int srgb : {0, 1}) {
    Scene scene = striped_scene(1024, 512, srgb);
    reduce_textures(scene);
    const uint mean = srgb == 1 ? 188u : 128u;
    for (uint texel : scene.reduced_texels) ASSERT_EQ(texel, mean | mean << 8 | mean << 16 | 128u << 24) << srgb;
  }
}

TEST(ReducedTextures, LieOneBehindTheOther) {
  Scene scene = striped_scene(512, 512, 1);
  scene.textures.push_back(scene.textures[0]);
  reduce_textures(scene);
  reduce_textures(scene);  // twice is the same as once
  ASSERT_EQ(scene.reduced_textures.size(), 2u);
  EXPECT_EQ(scene.reduced_textures[1].first_texel, 65536u);
  EXPECT_EQ(scene.reduced_texels.size(), 2u * 65536u);
}

}  // namespace
}  // namespace ods
