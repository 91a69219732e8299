// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/correct.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/stored_pictures.h"

namespace ods {
namespace {

constexpr Extent kSize{360, 180};

void world(vec3 d, float* out) {
  out[0] = 0.5f + 0.4f * std::sin(3.0f * d.x + 2.0f * d.y);
  out[1] = 0.5f + 0.4f * std::sin(4.0f * d.z - 3.0f * d.x * d.y);
  out[2] = 0.5f + 0.4f * std::cos(5.0f * d.y + d.x);
}

MadePicture make_world(const std::vector<int>& eyes) {
  StereoCamera stereo;
  stereo.top.mode = stereo.bottom.mode = kMergeCosine;
  MadePicture made = make_picture(stereo, kSize, eyes);
  const Camera camera = make_camera(stereo);
  add_colour(made, [=](int eye, vec2 uv, float* out) { world(camera_ray(camera, eye, uv).direction, out); });
  return made;
}

// The largest distance of an eye's pixels from a function of their direction, away from the sides, where an enlarged
// picture ends.
template <class Expected>
float error_of(const Image& image, const Expected& expected) {
  float largest = 0.0f;
  const Projection projection = make_projection({});
  for (int y = 0; y < image.height; y++) {
    for (int x = 6; x < image.width - 6; x++) {
      const vec2 uv((static_cast<float>(x) + 0.5f) / kSize.width, (static_cast<float>(y) + 0.5f) / kSize.height);
      vec3 seen;
      expected(look_of(projection, uv, uv).direction, &seen.x);
      for (int c = 0; c < 3; c++) largest = std::max(largest, std::abs(image.at(x, y)[c] - seen[c]));
    }
  }
  return largest;
}

void expect_right_eye(const EyeCorrection& correction) {
  SCOPED_TRACE(std::to_string(correction.raise) + " " + std::to_string(correction.zoom));
  const MadePicture made = make_world({kLeft, kRight});
  ConvertTarget target = same_format(made.picture);
  target.right = correction;
  ASSERT_EQ(conversion_fault(made.picture, target), "");
  const std::vector<Image> images = images_of(convert(made.picture, target).rows);
  EXPECT_LT(error_of(images[0], world), 1e-6f);
  const auto expected = [&](vec3 d, float* out) {
    vec3 light;
    world(stored_direction(correction, d), &light.x);
    light = corrected_color(correction, light);
    std::copy_n(&light.x, 3, out);
  };
  EXPECT_LT(error_of(images[1], expected), 0.003f);
}

TEST(Correct, TheRightEyeIsTakenFromWhereItsCorrectionSays) {
  EyeCorrection turned;
  turned.yaw = 2.0f, turned.pitch = 3.0f, turned.roll = -4.0f;
  expect_right_eye(turned);
  EyeCorrection raised;
  raised.raise = 1.5f;
  expect_right_eye(raised);
  EyeCorrection enlarged;
  enlarged.zoom = 1.02f;
  expect_right_eye(enlarged);
}

TEST(Correct, TheRightEyeGetsItsColours) {
  EyeCorrection graded;
  graded.gain = vec3(1.1f, 0.9f, 0.8f), graded.gamma = 1.2f;
  expect_right_eye(graded);
}

TEST(Correct, AMonoPictureOfTheRightEyeIsCorrectedToo) {
  const MadePicture made = make_world({kLeft, kRight});
  ConvertTarget target = same_format(made.picture);
  target.right.gain = vec3(0.5f);
  target.eyes = {kMono};
  target.mono_from = kRight;
  const auto half = [](vec3 d, float* out) {
    world(d, out);
    for (int c = 0; c < 3; c++) out[c] *= 0.5f;
  };
  EXPECT_LT(error_of(images_of(convert(made.picture, target).rows)[0], half), 1e-6f);
  target.mono_from = kLeft;
  EXPECT_LT(error_of(images_of(convert(made.picture, target).rows)[0], world), 1e-6f);
}

TEST(Correct, SaysWhatItCannotDo) {
  const MadePicture mono = make_world({kMono});
  ConvertTarget target = same_format(mono.picture);
  EXPECT_EQ(correction_fault(mono.picture, target), "");
  target.right.pitch = 1.0f;
  EXPECT_EQ(conversion_fault(mono.picture, target), "the picture has no right eye that could be corrected");
  const MadePicture both = make_world({kLeft, kRight});
  target = same_format(both.picture);
  target.right.pitch = 1.0f;
  target.camera.ipd = 0.05f;
  EXPECT_EQ(correction_fault(both.picture, target), "correct its right eye first, and move its eyes in a second step");
}

}  // namespace
}  // namespace ods
