// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures as cameras store them: circles off the middle, cut ones, and two that look ahead and back, made of a world
// that is known in every direction.
#include "ods/convert/unwrap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/base/error.h"
#include "ods/convert/convert.h"
#include "ods/disparity/rim.h"
#include "ods/identify/lenses.h"
#include "ods/picture/load_eyes.h"
#include "ods/picture/stored_lenses.h"
#include "tests/support/exact_projection.h"
#include "tests/support/stored_pictures.h"
#include "tests/support/waves.h"

namespace ods {
namespace {

constexpr Extent kEye{300, 280};

ProjectionSetting curve_of(const FisheyeLens& lens) {
  ProjectionSetting setting;
  setting.kind = lens.kind, setting.fov = lens.fov;
  return setting;
}

// The direction that a lens sees at an image position, if it is within the circle.
bool look(const FisheyeLens& lens, Extent eye, vec2 uv, vec3& direction) {
  const vec2 at =
      (uv * vec2(static_cast<float>(eye.width), static_cast<float>(eye.height)) - lens.center) / lens.radius;
  if (length(at) > 1.0f) return false;
  const vec3 own(exact_fisheye(curve_of(lens), dvec2(0.5f + 0.5f * at)));
  const auto axes =
      orientation(glm::radians(static_cast<double>(lens.yaw)), glm::radians(static_cast<double>(lens.pitch)),
                  glm::radians(static_cast<double>(lens.roll)));
  direction = vec3(axes[0]) * own.x + vec3(axes[1]) * own.y + vec3(axes[2]) * own.z;
  return true;
}

// eye: its size as players show it. across: stored pixels for each of its columns.
MadePicture picture_of(const std::vector<FisheyeLens>& lenses, Extent eye, const Waves& waves, double across = 1.0) {
  StereoCamera camera;
  camera.ipd = 0.0f;
  const Extent stored{static_cast<int>(std::lround(eye.width * across)), eye.height};
  MadePicture made = make_picture(camera, stored, {kLeft, kRight});
  made.picture.is_float = true;
  made.picture.layout = Layout::kSideBySide;
  add_layer<float>(made, {"R", "G", "B"}, LayerRule::kLight, SampleType::kFloat, [&](int which, vec2 uv, float* out) {
    const FisheyeLens& lens = lenses[which == kRight ? 1 : 0];
    vec3 d(0.0f);
    const float light = look(lens, eye, uv, d) ? waves(d) : 0.0f;
    out[0] = light, out[1] = 0.5f * light, out[2] = 1.0f - light;
  });
  return made;
}

// The largest and the usual difference to the world, where a direction is `near` at least from every rim.
struct Error2 {
  double maximum = 0.0, mean = 0.0;
};
Error2 error_of(const StoredPicture& picture, const ConvertTarget& target, const Waves& waves) {
  const Conversion conversion = convert(picture, target);
  const size_t channels = count_channels(conversion.rows.layers);
  std::vector<float> row(channels * static_cast<size_t>(target.eye.width));
  Error2 error;
  double count = 0.0;
  const Projection projection = make_projection(target.camera.projection);
  for (int y = 0; y < target.eye.height; y++) {
    conversion.rows.fill(static_cast<int>(target.eyes.size()) - 1, y, row);
    for (int x = 0; x < target.eye.width; x++) {
      const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(target.eye.width),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(target.eye.height));
      const vec3 d = look_of(projection, uv, uv).direction;
      if (target.eyes[0] != kMono && d.z > -0.15f) continue;  // a circle's rim
      const double off = std::abs(static_cast<double>(row[channels * static_cast<size_t>(x)] - waves(d)));
      error.maximum = std::max(error.maximum, off), error.mean += off, count++;
    }
  }
  error.mean /= count;
  return error;
}

FisheyeLens lens_at(float x, float y, float radius, float fov) {
  FisheyeLens lens;
  lens.center = vec2(x, y), lens.radius = radius, lens.fov = fov;
  return lens;
}

TEST(StoredLenses, CirclesOffTheMiddleAreUnwrappedExactly) {
  const Waves waves;
  FisheyeLens left = lens_at(143.3f, 135.8f, 131.0f, 190.0f), right = lens_at(155.6f, 141.1f, 131.0f, 190.0f);
  for (int kind = 0; kind < kProjectionCount; kind++) {
    if (!is_fisheye(kind)) continue;
    left.kind = right.kind = kind;
    MadePicture made = picture_of({left, right}, kEye, waves);
    FormatHint known;
    known.lenses = {left, right};
    take_lenses(made.picture, known, kEye, "a");
    ASSERT_TRUE(is_vr180(made.picture.camera.projection));
    ConvertTarget target = same_format(made.picture);
    EXPECT_EQ(target.eyes, (std::vector<int>{kLeft, kRight}));
    EXPECT_FALSE(is_same_picture(made.picture, target));
    const double density = pixels_per_radian(curve_of(left), 2.0 * 131.0);  // in the lens's middle
    EXPECT_NEAR(target.eye.width, density * std::acos(-1.0), 4.0);
    const Error2 error = error_of(made.picture, target, waves);
    EXPECT_LT(error.maximum, 0.03) << kind;
    EXPECT_LT(error.mean, 0.003) << kind;
    EXPECT_EQ(unwrapped(made.picture).eyes.size(), 2u);
    EXPECT_TRUE(unwrapped(made.picture).maps.empty());
  }
}

// The circles of a file whose pixels are not square, or whose eyes are squeezed, are circles where players show them.
TEST(StoredLenses, CirclesAreInTheEyeAsItIsShown) {
  const Waves waves;
  const FisheyeLens left = lens_at(143.3f, 135.8f, 131.0f, 190.0f), right = lens_at(155.6f, 141.1f, 131.0f, 190.0f);
  for (const double across : {0.75, 1.5}) {
    MadePicture made = picture_of({left, right}, kEye, waves, across);
    FormatHint known;
    known.lenses = {left, right};
    take_lenses(made.picture, known, kEye, "a");
    const Error2 error = error_of(made.picture, same_format(made.picture), waves);
    EXPECT_LT(error.maximum, 0.04) << across;
    EXPECT_LT(error.mean, 0.004) << across;
  }
}

// The sensor is lower than the circle: what is cut is empty, not something else.
TEST(StoredLenses, CutCirclesLeaveEmptyWhatTheyDoNotHave) {
  const Waves waves;
  const FisheyeLens lens = lens_at(150.0f, 140.0f, 160.0f, 180.0f);
  MadePicture made = picture_of({lens, lens}, kEye, waves);
  FormatHint known;
  known.lenses = {lens};
  take_lenses(made.picture, known, kEye, "a");
  const Conversion conversion = convert(made.picture, same_format(made.picture));
  EXPECT_EQ(conversion.rows.layers[0].channels.back(), "A") << "the target sees more than the picture has";
  const int height = conversion.rows.eye.height;
  std::vector<float> row(4 * static_cast<size_t>(conversion.rows.eye.width));
  conversion.rows.fill(0, 0, row);
  EXPECT_EQ(row[4 * static_cast<size_t>(conversion.rows.eye.width / 2) + 3], 0.0f) << "straight up is cut off";
  conversion.rows.fill(0, height / 2, row);
  EXPECT_EQ(row[4 * static_cast<size_t>(conversion.rows.eye.width / 2) + 3], 1.0f);
}

TEST(StoredLenses, FrontAndBackBecomeOneSphere) {
  const Waves waves;
  FisheyeLens front = lens_at(148.0f, 139.0f, 138.0f, 200.0f), back = lens_at(151.5f, 141.0f, 137.0f, 200.0f);
  for (const float roll : {0.0f, 90.0f}) {
    front.roll = roll, back.roll = -roll + 2.0f;
    FisheyeLens made_back = back;
    made_back.yaw = 180.0f;
    MadePicture made = picture_of({front, made_back}, kEye, waves);
    FormatHint known;
    known.lenses = {front, back}, known.front_and_back = true;
    take_lenses(made.picture, known, kEye, "a");
    const ConvertTarget target = same_format(made.picture);
    EXPECT_EQ(target.eyes, std::vector<int>{kMono});
    EXPECT_TRUE(is_full_lat_long(target.camera.projection));
    EXPECT_NEAR(target.eye.width, 138.0 * 720.0 / 200.0, 6.0);
    const Error2 error = error_of(made.picture, target, waves);
    EXPECT_LT(error.maximum, 0.05) << roll << ": everywhere, at the seam and at the poles";
    EXPECT_LT(error.mean, 0.004) << roll;
  }
}

// Two lenses of unlike exposure: over the seam brightness changes little by little.
TEST(StoredLenses, TheSeamIsBlended) {
  FisheyeLens lens = lens_at(150.0f, 140.0f, 139.0f, 200.0f);
  StereoCamera camera;
  MadePicture made = make_picture(camera, kEye, {kLeft, kRight});
  made.picture.is_float = true, made.picture.layout = Layout::kSideBySide;
  add_layer<float>(made, {"R", "G", "B"}, LayerRule::kLight, SampleType::kFloat,
                   [&](int which, vec2, float* out) { std::fill_n(out, 3, which == kRight ? 0.4f : 0.6f); });
  FormatHint known;
  known.lenses = {lens}, known.front_and_back = true;
  take_lenses(made.picture, known, kEye, "a");
  ConvertTarget target = same_format(made.picture);
  target.eye = {720, 360};
  const Conversion conversion = convert(made.picture, target);
  std::vector<float> row(count_channels(conversion.rows.layers) * 720);
  for (const int y : {20, 180, 300}) {
    conversion.rows.fill(0, y, row);
    const size_t channels = row.size() / 720;
    float steepest = 0.0f;
    for (size_t x = 0; x + 1 < 720; x++) {
      steepest = std::max(steepest, std::abs(row[channels * x] - row[channels * (x + 1)]));
    }
    EXPECT_LT(steepest, 0.2f / 4.0f) << y;
    EXPECT_NEAR(row[channels * 360], 0.6f, 1e-4f);
    EXPECT_NEAR(row[0], 0.4f, 1e-4f);
    EXPECT_NEAR(0.5f * (row[channels * 179] + row[channels * 180]), 0.5f, 0.01f) << "half of each at 90 degrees";
  }
}

TEST(StoredLenses, WhatIsNoCircleOfThePictureIsRefused) {
  const Waves waves;
  const MadePicture made = picture_of({lens_at(150, 140, 130, 180), lens_at(150, 140, 130, 180)}, kEye, waves);
  const auto fault = [&](const std::vector<FisheyeLens>& lenses, bool front_and_back, bool one) {
    StoredPicture picture = made.picture;
    if (one) picture.eyes.resize(1);
    FormatHint known;
    known.lenses = lenses, known.front_and_back = front_and_back;
    try {
      take_lenses(picture, known, kEye, "a.jpg");
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(fault({lens_at(150, 140, 130, 180)}, false, false), "");
  EXPECT_EQ(fault({}, true, false), "");
  EXPECT_NE(fault({lens_at(450, 140, 130, 180)}, false, false).find("outside"), std::string::npos);
  EXPECT_NE(fault({lens_at(NAN, 140, 130, 180)}, false, false), "");
  EXPECT_NE(fault({lens_at(150, 140, NAN, 180)}, false, false), "");
  EXPECT_NE(fault({lens_at(150, 140, 0, 180)}, false, false), "");
  EXPECT_NE(fault({lens_at(150, 140, 1e9f, 180)}, false, false), "");
  EXPECT_NE(fault({lens_at(150, 140, 130, 400)}, false, false), "");
  EXPECT_NE(fault({}, true, true).find("two halves"), std::string::npos);
}

// --- rims ------------------------------------------------------------------------------------------------------------

Image image_of(const FisheyeLens& lens, Extent size, const std::function<float(vec3)>& world) {
  Image image(size.width, size.height, 1);
  for (int y = 0; y < size.height; y++) {
    for (int x = 0; x < size.width; x++) {
      float sum = 0.0f;
      for (int i = 0; i < 16; i++) {
        const vec2 uv(
            (static_cast<float>(x) + (static_cast<float>(i % 4) + 0.5f) / 4.0f) / static_cast<float>(size.width),
            (static_cast<float>(y) + (static_cast<float>(i / 4) + 0.5f) / 4.0f) / static_cast<float>(size.height));
        vec3 d(0.0f);
        sum += look(lens, size, uv, d) ? world(d) : 0.0f;
      }
      *image.at(x, y) = sum / 16.0f;
    }
  }
  return image;
}

TEST(Rim, IsFoundToAFractionOfAPixel) {
  const Waves waves;
  const FisheyeLens lenses[] = {lens_at(150, 140, 139, 180), lens_at(140.4f, 145.7f, 120.3f, 180),
                                lens_at(150, 140, 165, 180), lens_at(171.2f, 128.6f, 150.5f, 190)};
  for (const FisheyeLens& lens : lenses) {
    for (const bool dark_below : {false, true}) {
      if (dark_below && lens.radius > 145.0f) continue;  // too little is left of it
      const std::optional<Rim> rim = find_rim(image_of(lens, kEye, [&](vec3 d) {
        return dark_below && d.y < -0.5f ? 0.005f : 0.25f + 0.7f * std::clamp(waves(d), 0.0f, 1.0f);
      }));
      ASSERT_TRUE(rim) << lens.radius << dark_below;
      EXPECT_NEAR(rim->center.x, lens.center.x, 0.5f) << lens.radius << dark_below;
      EXPECT_NEAR(rim->center.y, lens.center.y, 0.5f) << lens.radius << dark_below;
      EXPECT_NEAR(rim->radius, lens.radius, 0.5f) << lens.radius << dark_below;
    }
  }
}

TEST(Rim, IsNotFoundWhereThereIsNone) {
  const Waves waves;
  Image flat(300, 280, 1), box = flat, black = flat;
  for (int y = 0; y < 280; y++) {
    for (int x = 0; x < 300; x++) {
      const vec3 d = normalize(vec3(static_cast<float>(x) / 100.0f, static_cast<float>(y) / 100.0f, 1.0f));
      *flat.at(x, y) = std::clamp(waves(d), 0.0f, 1.0f);
      if (x > 40 && x < 260 && y > 30 && y < 250) *box.at(x, y) = 0.6f;
    }
  }
  EXPECT_FALSE(find_rim(flat));
  EXPECT_FALSE(find_rim(box));
  EXPECT_FALSE(find_rim(black));
  EXPECT_FALSE(find_rim(Image(8, 8, 1)));
}

// --- what files show -------------------------------------------------------------------------------------------------

float lit(const Waves& waves, vec3 d) {
  return std::clamp(0.1f + 0.5f * std::clamp(waves(d), 0.0f, 1.0f) + 0.25f * d.y + 0.15f, 0.02f, 1.0f);
}

TEST(Lenses, AheadAndBackAreFoundAndAligned) {
  for (const uint32_t seed : {5u, 6u}) {
    const Waves waves(seed);
    FisheyeLens front = lens_at(150.0f, 140.0f, 136.0f, 195.0f), back = lens_at(147.0f, 141.0f, 136.0f, 195.0f);
    back.yaw = 181.0f, back.pitch = 0.6f, back.roll = 1.5f;
    const auto world = [&](vec3 d) { return lit(waves, d); };
    const auto seen = find_lenses({image_of(front, kEye, world), image_of(back, kEye, world)}, std::nullopt);
    ASSERT_TRUE(seen) << seed;
    EXPECT_TRUE(seen->front_and_back) << seed << " " << seen->alike;
    EXPECT_NEAR(seen->lenses[0].fov, 195.0f, 1.0f) << seed;
    EXPECT_NEAR(seen->lenses[0].roll, 0.0f, 0.1f);
    EXPECT_NEAR(std::remainder(seen->lenses[1].roll, 360.0f), 1.5f, 0.6f) << seed;
    EXPECT_NEAR(seen->lenses[1].yaw, 1.0f, 0.6f) << seed;
    EXPECT_NEAR(seen->lenses[1].pitch, 0.6f, 0.6f) << seed;
  }
}

// Sensors turned on their sides: the light shows which way is up.
TEST(Lenses, TurnedOnesAreSetUpright) {
  const Waves waves;
  for (const float roll : {0.0f, 90.0f, 180.0f, 270.0f}) {
    FisheyeLens front = lens_at(150.0f, 140.0f, 136.0f, 200.0f), back = front;
    front.roll = roll, back.roll = -roll, back.yaw = 180.0f;
    const auto world = [&](vec3 d) { return lit(waves, d); };
    const auto seen = find_lenses({image_of(front, kEye, world), image_of(back, kEye, world)}, std::nullopt);
    ASSERT_TRUE(seen && seen->front_and_back) << roll;
    EXPECT_NEAR(std::remainder(seen->lenses[0].roll - roll, 360.0f), 0.0f, 1.0f) << roll;
    EXPECT_NEAR(std::remainder(seen->lenses[1].roll + roll, 360.0f), 0.0f, 1.0f) << roll;
  }
}

TEST(Lenses, APairThatLooksAheadIsNotTakenForOneThatLooksBack) {
  const Waves waves;
  const FisheyeLens left = lens_at(142.0f, 138.0f, 125.0f, 180.0f), right = lens_at(157.0f, 141.0f, 125.0f, 180.0f);
  // A near thing in front of a far world, so that the eyes differ.
  const auto world = [&](float shift) {
    return [&waves, shift](vec3 d) { return lit(waves, normalize(d + vec3(d.z < -0.8f ? shift : 0.0f, 0.0f, 0.0f))); };
  };
  const auto seen =
      find_lenses({image_of(left, kEye, world(0.01f)), image_of(right, kEye, world(-0.01f))}, std::nullopt);
  ASSERT_TRUE(seen);
  EXPECT_FALSE(seen->front_and_back);
  EXPECT_NEAR(seen->lenses[0].center.x, 142.0f, 0.5f);
  EXPECT_NEAR(seen->lenses[1].center.x, 157.0f, 0.5f);
}

}  // namespace
}  // namespace ods
