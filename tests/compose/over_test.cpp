// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture before another, against the formula.
#include "ods/compose/over.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/stored_pictures.h"

namespace ods {
namespace {

const std::vector<int> kBoth{kLeft, kRight};
constexpr Extent kSize{32, 16};

// The left half of a picture is at 2 metres and half covered, the right one at 4 and not.
MadePicture front_picture(const StereoCamera& camera, Extent size = kSize) {
  MadePicture made = make_picture(camera, size, kBoth);
  made.picture.has_ipd = true;
  add_layer<float>(made, {"R", "G", "B", "A"}, LayerRule::kLight, SampleType::kFloat, [](int eye, vec2 uv, float* out) {
    const float alpha = uv.x < 0.5f ? 0.5f : 1.0f;
    out[0] = alpha * 0.2f, out[1] = alpha * static_cast<float>(eye), out[2] = alpha, out[3] = alpha;
  });
  add_layer<float>(made, {"Z"}, LayerRule::kNearest, SampleType::kFloat,
                   [](int, vec2 uv, float* out) { *out = uv.x < 0.5f ? 2.0f : 4.0f; });
  return made;
}

MadePicture back_picture(const StereoCamera& camera, bool has_depth = true) {
  MadePicture made = make_picture(camera, kSize, kBoth);
  made.picture.has_ipd = true;
  add_colour(made, [](int, vec2 uv, float* out) { out[0] = uv.y, out[1] = 0.0f, out[2] = 0.5f; });
  if (has_depth)
    add_layer<float>(made, {"Z"}, LayerRule::kNearest, SampleType::kFloat, [](int, vec2, float* out) { *out = 3.0f; });
  return made;
}

TEST(Over, IsPorterAndDuffsOver) {
  const MadePicture front = front_picture(StereoCamera()), back = back_picture(StereoCamera());
  OverOptions options;
  options.opacity = 0.5f;
  ASSERT_EQ(over_fault(front.picture, back.picture, options), "");
  const std::vector<Image> images = images_of(lay_over(front.picture, back.picture, options).rows);
  for (int eye : {0, 1}) {
    for (int y = 0; y < kSize.height; y++) {
      for (int x = 0; x < kSize.width; x++) {
        const float* pixel = images[static_cast<size_t>(eye)].at(x, y);
        const float alpha = x < kSize.width / 2 ? 0.25f : 0.5f, v = (static_cast<float>(y) + 0.5f) / 16.0f;
        EXPECT_NEAR(pixel[0], 0.2f * alpha + v * (1.0f - alpha), 1e-6f);
        EXPECT_NEAR(pixel[1], static_cast<float>(eye) * alpha, 1e-6f);
        EXPECT_NEAR(pixel[2], alpha + 0.5f * (1.0f - alpha), 1e-6f);
        EXPECT_EQ(pixel[3], 3.0f);  // what is seen through keeps its depth
      }
    }
  }
}

TEST(Over, ByDepthTheNearerIsSeen) {
  const MadePicture front = front_picture(StereoCamera()), back = back_picture(StereoCamera());
  OverOptions options;
  options.by_depth = true;
  const std::vector<Image> images = images_of(lay_over(front.picture, back.picture, options).rows);
  EXPECT_NEAR(images[0].at(2, 8)[2], 0.5f + 0.25f, 1e-6f);
  EXPECT_EQ(images[0].at(20, 8)[2], 0.5f);
  EXPECT_EQ(images[0].at(20, 8)[3], 3.0f);
}

TEST(Over, TheForegroundTakesTheBackgroundsForm) {
  StereoCamera half;
  half.projection = projection_named("vr180");
  const MadePicture front = front_picture(half, {64, 64}), back = back_picture(StereoCamera());
  ASSERT_EQ(over_fault(front.picture, back.picture, {}), "");
  const std::vector<Image> images = images_of(lay_over(front.picture, back.picture, {}).rows);
  EXPECT_EQ(images[0].width, kSize.width);
  EXPECT_NEAR(images[0].at(12, 8)[2], 0.75f, 1e-3f);  // ahead to the left
  EXPECT_NEAR(images[0].at(20, 8)[2], 1.0f, 1e-3f);   // to the right
  EXPECT_NEAR(images[0].at(2, 8)[2], 0.5f, 1e-6f);    // behind there is none of it
}

TEST(Over, WarnsOfOtherEyes) {
  StereoCamera narrow, merged;
  narrow.ipd = 0.05f;
  merged.top.mode = kMergeCosine;
  MadePicture back = back_picture(StereoCamera(), false);
  const auto said = [&](const StereoCamera& camera) {
    return ::testing::PrintToString(over_warnings(front_picture(camera).picture, back.picture));
  };
  EXPECT_NE(said(narrow).find("50 mm"), std::string::npos) << said(narrow);
  EXPECT_NE(said(merged).find("pole merge"), std::string::npos) << said(merged);
  EXPECT_EQ(over_warnings(front_picture(StereoCamera()).picture, back.picture).size(), 0u);
  EXPECT_EQ(over_fault(front_picture(narrow).picture, back.picture, {}), "");  // taken as it is
  back.picture.has_ipd = false;  // footage of others does not record its eye distance
  EXPECT_EQ(over_warnings(front_picture(narrow).picture, back.picture).size(), 0u);
  EXPECT_EQ(over_warnings(front_picture(merged).picture, back.picture).size(), 0u);
}

// Maps that were read from two files are one map if they are the same.
TEST(Over, WarnsOfAnotherTilt) {
  const auto tilted = [](float value) {
    StereoCamera camera;
    auto map = std::make_shared<Image>(2, 1, 1);
    map->pixels = {value, value};
    camera.head_tilt_map = map;
    return camera;
  };
  const MadePicture back = back_picture(tilted(0.7f), false);
  EXPECT_EQ(over_warnings(front_picture(tilted(0.7f)).picture, back.picture).size(), 0u);
  for (const StereoCamera& other : {tilted(0.6f), StereoCamera()}) {
    const MadePicture front = front_picture(other);
    const std::vector<std::string> warnings = over_warnings(front.picture, back.picture);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("`head-tilt-map`"), std::string::npos) << warnings[0];
    EXPECT_EQ(over_fault(front.picture, back.picture, {}), "") << "taken as it is";
  }
}

TEST(Over, WarnsOfWhatStandsBehindWhatItCovers) {
  const MadePicture front = front_picture(StereoCamera()), back = back_picture(StereoCamera());
  const Overlay overlay = lay_over(front.picture, back.picture, {});
  EXPECT_EQ(behind_warning(overlay), "");
  images_of(overlay.rows);
  const std::string warning = behind_warning(overlay);
  EXPECT_NE(warning.find("100 %"), std::string::npos) << warning;  // of what covers more than half
}

TEST(Over, RefusalsSayWhy) {
  const MadePicture front = front_picture(StereoCamera()), back = back_picture(StereoCamera(), false);
  OverOptions by_depth;
  by_depth.by_depth = true;
  EXPECT_NE(over_fault(front.picture, back.picture, by_depth).find("depth"), std::string::npos);
  EXPECT_NE(over_fault(back.picture, back.picture, {}).find("alpha"), std::string::npos);
  MadePicture one = make_picture(StereoCamera(), kSize, {kMono});
  add_colour(one, [](int, vec2, float* out) { out[0] = out[1] = out[2] = 0.0f; });
  EXPECT_NE(over_fault(front.picture, one.picture, {}).find("two eyes"), std::string::npos);
}

}  // namespace
}  // namespace ods
