// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/exposure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/render/cpu/render.h"
#include "tests/support/stage_scenes.h"

namespace ods {
namespace {

// A look at surfaces of one luminance, and others of another on this share of the rows from the top.
Picture look_at(float light, float other = 0.0f, int rows = 0, float depth = 1.0f) {
  EyeImage eye;
  eye.radiance = Image(192, 96, 3);
  eye.depth = Image(192, 96, 1);
  for (int y = 0; y < 96; y++) {
    for (int x = 0; x < 192; x++) {
      for (int c = 0; c < 3; c++) eye.radiance.at(x, y)[c] = y < rows ? other : light;
      *eye.depth.at(x, y) = y < rows ? depth : 1.0f;
    }
  }
  Picture picture;
  picture.eyes.push_back(eye);
  return picture;
}

float exposure_of(const Picture& look) {
  return suitable_exposure({&look, 1}).value();
}

// The sky through windows may burn out; as much light on surfaces may not, nor the sky over a place.
TEST(Exposure, IsThatOfTheRoomNotOfItsWindows) {
  const float lit = kExposedMean / 64.0f;
  const float room = exposure_of(look_at(lit, 2.0f, 24, kFarDepth));
  EXPECT_GT(room, 4.0f) << "the top 24 of 96 rows are 15 percent of the sphere";
  EXPECT_LT(exposure_of(look_at(lit, 2.0f, 24, 1.0f)), 0.0f);
  EXPECT_LT(exposure_of(look_at(lit, 2.0f, 40, kFarDepth)), 0.0f);
}

TEST(Exposure, BringsTheMeanToMiddleGrey) {
  EXPECT_EQ(exposure_of(look_at(kExposedMean)), 0.0f);
  EXPECT_EQ(exposure_of(look_at(4.0f * kExposedMean)), -2.0f);
  EXPECT_EQ(exposure_of(look_at(kExposedMean / 32.0f)), 5.0f);
  EXPECT_EQ(exposure_of(look_at(20000.0f)), std::round(10.0f * std::log2(kExposedMean / 20000.0f)) / 10.0f);
}

TEST(Exposure, IsRoundedToTenthsSoThatItCanBeRepeated) {
  for (const float light : {0.017f, 0.3f, 5.1f}) {
    const float stops = exposure_of(look_at(light));
    EXPECT_NEAR(10.0f * stops, std::round(10.0f * stops), 1e-4f);
  }
}

TEST(Exposure, KeepsHighlights) {
  // A dark room whose windows are a fifth of the sphere.
  const Picture look = look_at(0.01f, 1.0f, 36);
  EXPECT_NEAR(exposure_of(look), std::log2(kHighlight), 0.06f) << "the windows decide, not the walls";
  EXPECT_NEAR(exposure_of(look_at(0.01f, 30.0f, 8)), std::log2(kExposedMean / 0.01f), 0.5f) << "a lamp may be white";
}

TEST(Exposure, BlackDoesNotCount) {
  EXPECT_EQ(exposure_of(look_at(kExposedMean, 0.0f, 80)), 0.0f) << "space around a lit moon";
  const Picture black = look_at(0.0f);
  EXPECT_FALSE(suitable_exposure({&black, 1}));
}

TEST(Exposure, TheSkyDoesNotDecideForWhatStandsBeforeIt) {
  const float with_wall = exposure_of(look_at(0.1f, 0.6f, 80)),
              with_sky = exposure_of(look_at(0.1f, 0.6f, 80, kFarDepth));
  EXPECT_GT(with_sky, with_wall + 0.5f);
}

TEST(Exposure, FramesOfAVideoShareOne) {
  const Picture looks[] = {look_at(0.5f * kExposedMean), look_at(2.0f * kExposedMean)};
  EXPECT_EQ(suitable_exposure(looks), 0.0f);
}

TEST(Exposure, TheLookIsTheSameWhateverTheThreadsAndThePicture) {
  Scene scene = make_courtyard();
  scene.environment.radiance = vec3(0.4f);
  StereoCamera camera;
  camera.position = vec3(0, 1.6f, 0);
  RenderOptions one, two;
  one.threads = 1, two.threads = 2, two.width = 4096, two.samples = 7, two.seed = 5;
  const Picture a = render_cpu(scene, metering_camera(camera), metering_options(one));
  camera.ipd = 0.1f;
  const Picture b = render_cpu(scene, metering_camera(camera), metering_options(two));
  EXPECT_EQ(a.eyes[0].radiance.pixels, b.eyes[0].radiance.pixels);
  EXPECT_EQ(exposure_of(a), exposure_of(b));
}

}  // namespace
}  // namespace ods
