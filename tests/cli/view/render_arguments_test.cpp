// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The studio's command gives the camera that the studio shows: every merge, convergence and projection, and all
// numbers.
#include "cli/view/render_arguments.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cli/options/camera_options.h"
#include "ods/camera/camera_fields.h"
#include "tests/support/temporary_folder.h"

namespace ods::render_words_test {

constexpr int kWidth = 768;

// The camera that ods render makes of the arguments.
StereoCamera read_words(std::vector<std::string> words) {
  CameraOptions camera;
  Options options("test", std::move(words));
  add_camera_options(options, camera);
  int height = 0;
  options.number("--height", height, 1, 100'000, "");
  EXPECT_NO_THROW(options.parse());
  finish_camera_options(camera, kWidth, height);
  return place_camera(camera);
}

class RenderArguments : public ::testing::Test {
 protected:
  void expect_restated(const StereoCamera& wanted) const {
    ASSERT_EQ(camera_fault(wanted), "");
    const std::string maps = folder_.path("camera");
    save_maps(wanted, maps);
    const std::vector<std::string> words = camera_arguments(wanted, kWidth, maps);
    const std::string line = fmt::format("{}", fmt::join(words, " "));
    StereoCamera got = read_words(words);
    EXPECT_TRUE(same_merge(got.top, wanted.top)) << line;
    EXPECT_TRUE(same_merge(got.bottom, wanted.bottom)) << line;
    EXPECT_TRUE(same_eyes(got, wanted)) << line;
    EXPECT_TRUE(same_map(got.head_tilt_map, wanted.head_tilt_map)) << line;
    EXPECT_NEAR(got.projection.aspect, wanted.projection.aspect, 0.01f) << line;
    got.projection.aspect = wanted.projection.aspect;
    EXPECT_EQ(got.projection, wanted.projection) << line;
    EXPECT_EQ(got.convergence, wanted.convergence) << line;
    for (const CameraFieldRow& row : camera_fields()) {
      if (!row.matters(wanted) || row.setting == "aspect" || row.setting == "axis") continue;
      EXPECT_EQ(values_of(got, row), values_of(wanted, row)) << row.name << ": " << line;
    }
    ASSERT_EQ(got.axis.has_value(), wanted.axis.has_value()) << line;
    EXPECT_LT(length(got.axis.value_or(vec3(0, 1, 0)) - normalize(wanted.axis.value_or(vec3(0, 1, 0)))), 1e-6f) << line;
    EXPECT_EQ(got.mirrored, wanted.mirrored) << line;
  }

  static std::shared_ptr<const Image> map(float phase) {
    auto image = std::make_shared<Image>(16, 8, 1);
    for (size_t i = 0; i < image->pixels.size(); i++) {
      image->pixels[i] = 0.5f + 0.5f * std::sin(phase + 0.37f * static_cast<float>(i));
    }
    return image;
  }

  TemporaryFolder folder_;
};

TEST_F(RenderArguments, HaveEveryMerge) {
  for (const int mode : kMerges) {
    for (const int other : {mode, int{kMergeNone}, int{kMergeCosine}}) {
      StereoCamera camera = usual_camera();
      camera.top = {mode, 30.5f, 80.0f, 1.5f};
      camera.bottom = {other, 30.5f, 80.0f, 1.5f};
      if (mode == kMergeMap) camera.merge_map = map(1.0f);
      expect_restated(camera);
      std::swap(camera.top, camera.bottom);
      camera.head_tilt_map = map(2.0f);
      expect_restated(camera);
    }
  }
}

TEST_F(RenderArguments, HaveEveryProjection) {
  for (const NamedProjection& named : named_projections()) {
    StereoCamera camera = usual_camera();
    camera.projection = named.setting;
    expect_restated(camera);
    ProjectionSetting& setting = camera.projection;
    if (has_range(setting.kind)) setting.longitude = vec2(-100.0f, 80.5f), setting.latitude = vec2(-40.0f, 50.0f);
    if (has_fov(setting.kind)) setting.fov = 77.5f;
    if (has_lens(setting.kind)) setting.pan = -20.0f, setting.tilt = 35.0f;
    if (setting.kind == kPerspective) setting.aspect = 1.6f;
    if (setting.kind == kFisheyePolynomial) setting.sensor = vec2(30.0f, 20.0f), setting.polynomial[1] *= 1.1f;
    expect_restated(camera);
  }
}

TEST_F(RenderArguments, HaveEveryNumber) {
  StereoCamera camera = usual_camera();
  expect_restated(camera);
  camera.position = vec3(-1.25f, 2.0f, 1e-7f);
  camera.yaw = -123.456f, camera.pitch = -7.0f, camera.roll = 0.1f;
  for (const CameraFieldRow& row : camera_fields()) {
    if (!row.help.empty()) *row.numbers(camera)[0] = 0.0633f;
  }
  camera.axis = vec3(0.1f, 2.0f, -0.3f);
  camera.lens_radius = 0.0025f, camera.focus_distance = 3.3f;
  camera.mirrored = true;
  for (const int convergence : kConvergences) {
    camera.convergence = convergence;
    camera.convergence_distance = 1.7f;
    expect_restated(camera);
  }
}

}  // namespace ods::render_words_test
