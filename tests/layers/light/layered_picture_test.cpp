// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/light/layered_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "ods/base/error.h"
#include "ods/image/tone.h"
#include "ods/picture/load_eyes.h"
#include "tests/support/temporary_folder.h"

namespace ods::layered_picture_test {

constexpr int kWidth = 512;
const vec3 kLeftColour(0.2f, 0.6f, 0.4f), kRightColour(0.8f, 0.2f, 0.7f), kSkyColour(0.0f, 0.0f, 1.0f);

// An upright rectangle in front of a point, of one colour. Its front faces the point if left < right.
LayerMesh rectangle(vec3 point, float left, float right, float distance, vec3 colour) {
  LayerMesh mesh;
  for (const vec2 corner : {vec2(left, -1), vec2(right, -1), vec2(right, 1), vec2(left, 1)}) {
    mesh.positions.push_back(point + vec3(corner, -distance));
  }
  mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.texture = Image(2, 2, 3);
  for (size_t i = 0; i < mesh.texture.pixels.size(); i++) mesh.texture.pixels[i] = colour[static_cast<int>(i % 3)];
  return mesh;
}

// Two walls that meet straight ahead, and a sky. A third wall is in front of them, but is seen from its back.
LayeredScene two_walls(float distance) {
  LayeredScene layers;
  layers.box.center = vec3(3, 1.5f, -2);
  layers.meshes = {rectangle(layers.box.center, -1, 0, distance, kLeftColour),
                   rectangle(layers.box.center, 0, 1, distance, kRightColour),
                   rectangle(layers.box.center, 1, -1, 0.5f * distance, vec3(0.0f)),
                   rectangle(vec3(0.0f), -9, 9, 1.0f, kSkyColour)};
  layers.meshes.back().kind = LayerKind::kSky;
  return layers;
}

class LayeredPicture : public ::testing::Test {
 protected:
  // The eyes of the written picture.
  std::vector<Image> eyes_of(const LayeredScene& layers) {
    write_layered_picture(layers, folder.path("walls_360_TB.png"), {kWidth});
    return load_eyes(folder.path("walls_360_TB.png")).eyes;
  }

  TemporaryFolder folder;
};

// The first column of the right wall at the horizon: the columns of the walls' colours on both sides of it.
int seam(const Image& eye) {
  for (int x = kWidth / 2 - 100; x < kWidth / 2 + 100; x++) {
    if (eye.at(x, kWidth / 4)[0] > srgb_decode(0.5f)) return x;
  }
  return -1;
}

TEST_F(LayeredPicture, ShowsTheColoursOfTheTextures) {
  const std::vector<Image> eyes = eyes_of(two_walls(1.0f));
  ASSERT_EQ(eyes.size(), 2u);
  for (const Image& eye : eyes) {
    ASSERT_EQ(eye.width, kWidth);
    for (int c = 0; c < 3; c++) {
      EXPECT_NEAR(eye.at(kWidth / 2 - 32, kWidth / 4)[c], srgb_decode(kLeftColour[c]), 0.004f);
      EXPECT_NEAR(eye.at(kWidth / 2 + 32, kWidth / 4)[c], srgb_decode(kRightColour[c]), 0.004f);
      EXPECT_NEAR(eye.at(kWidth / 2 + kWidth / 6, kWidth / 4)[c], srgb_decode(kSkyColour[c]), 0.004f);
    }
  }
}

// A point ahead at a distance d is seen by the eye on a circle of radius r at asin(r / d) to its inner side.
TEST_F(LayeredPicture, HasTheParallaxOfBothEyes) {
  const std::vector<Image> eyes = eyes_of(two_walls(0.5f));
  const double shift = std::asin(0.0325 / 0.5) / (2.0 * std::numbers::pi) * kWidth;
  EXPECT_NEAR(seam(eyes[0]), kWidth / 2 + shift, 1.0);
  EXPECT_NEAR(seam(eyes[1]), kWidth / 2 - shift, 1.0);
}

// A pane is blended in linear light: its share of the samples is random.
TEST_F(LayeredPicture, PanesAreBlended) {
  LayeredScene layers = two_walls(1.0f);
  LayerMesh pane = rectangle(layers.box.center, -1, 1, 0.5f, vec3(1.0f));
  pane.kind = LayerKind::kBlended;
  pane.texture = Image(1, 1, 4);
  pane.texture.pixels = {1.0f, 1.0f, 1.0f, 0.25f};
  layers.meshes.push_back(pane);
  const Image eye = eyes_of(layers)[0];
  for (int c = 0; c < 3; c++) {
    double sum = 0.0;
    for (int i = 0; i < 400; i++) sum += eye.at(kWidth / 2 - 48 + i % 20, kWidth / 4 - 10 + i / 20)[c];
    EXPECT_NEAR(sum / 400.0, 0.25 + 0.75 * srgb_decode(kLeftColour[c]), 0.03);
  }
}

TEST_F(LayeredPicture, TheEyesAreInASmallBox) {
  LayeredScene layers = two_walls(0.5f);
  layers.box.size = vec3(0.02f);
  const std::vector<Image> eyes = eyes_of(layers);
  const double shift = std::asin(0.01 / 0.5) / (2.0 * std::numbers::pi) * kWidth;
  EXPECT_NEAR(seam(eyes[0]) - seam(eyes[1]), 2.0 * shift, 1.5);
}

TEST_F(LayeredPicture, RefusesANameThatIsNoPicture) {
  EXPECT_THROW(check_layered_picture(folder.path("walls.txt")), Error);
  EXPECT_THROW(check_layered_picture(folder.path("absent/")), Error);
}

}  // namespace ods::layered_picture_test
