// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Lines of sight of a picture whose head is tilted by a map: where they are found, and which pictures have the same.
#include "ods/convert/panorama.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/statistics.h"
#include "tests/support/stored_pictures.h"

namespace ods {
namespace {

std::shared_ptr<const Image> map_of(int width, std::vector<float> values) {
  auto map = std::make_shared<Image>(width, static_cast<int>(values.size()) / width, 1);
  map->pixels = std::move(values);
  return map;
}

TEST(Panorama, FindsTheLinesOfATiltedHead) {
  Dice dice(1);
  for (const int convergence : kConvergences) {
    StereoCamera stereo;
    stereo.yaw = 30.0f;
    stereo.convergence = convergence, stereo.convergence_distance = 1.0f;
    stereo.top.mode = kMergeCosine;
    stereo.head_tilt_map = map_of(4, {0.2f, 0.5f, 0.9f, 0.4f, 1.0f, 0.3f, 0.0f, 0.6f});
    const MadePicture made = make_picture(stereo, {1024, 512}, {kLeft, kRight});
    const Source source = make_source(made.picture);
    for (int i = 0; i < 1000; i++) {
      const vec2 uv(dice.next(), dice.between(0.05f, 0.95f));
      const int eye = i % 2;
      const Place place = place_of_line(source, eye, camera_ray(source.camera, eye, uv).direction);
      ASSERT_TRUE(place.seen);
      ASSERT_EQ(place.source_eye, eye);
      ASSERT_NEAR(place.at.x, uv.x * 1024.0f, 0.01f) << convergence;
      ASSERT_NEAR(place.at.y, uv.y * 512.0f, 0.01f) << convergence;
    }
  }
}

// A map turns with the camera: only one that is the same all around lets a picture be turned without depth.
TEST(Panorama, APictureOfATiltedHeadTurnsIfItsMapDoesNotVaryAround) {
  const auto fault = [](const StereoCamera& camera, const auto& change) {
    const MadePicture made = make_picture(camera, {64, 32}, {kLeft, kRight});
    ConvertTarget target = target_of(made, camera.projection, {64, 32});
    change(target.camera);
    return conversion_fault(made.picture, target);
  };
  const auto turn = [](StereoCamera& camera) { camera.yaw = 40.0f; };
  const auto read_again = [](StereoCamera& camera) {
    if (camera.head_tilt_map) camera.head_tilt_map = std::make_shared<Image>(*camera.head_tilt_map);
    if (camera.merge_map) camera.merge_map = std::make_shared<Image>(*camera.merge_map);
  };
  const auto straighten = [](StereoCamera& camera) { camera.head_tilt_map = nullptr; };
  StereoCamera by_height, around, merged;
  by_height.head_tilt_map = map_of(2, {0.2f, 0.2f, 0.9f, 0.9f});
  around.head_tilt_map = map_of(2, {0.2f, 0.3f, 0.9f, 0.9f});
  merged.top.mode = kMergeMap, merged.merge_map = around.head_tilt_map;
  EXPECT_EQ(fault(by_height, turn), "");
  EXPECT_NE(fault(around, turn).find("needs depth"), std::string::npos);
  EXPECT_NE(fault(merged, turn).find("needs depth"), std::string::npos);
  for (const StereoCamera& camera : {by_height, around, merged}) EXPECT_EQ(fault(camera, read_again), "");
  EXPECT_NE(fault(by_height, straighten).find("needs depth"), std::string::npos);
}

}  // namespace
}  // namespace ods
