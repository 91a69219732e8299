// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/cycles_camera.h"

#include <gtest/gtest.h>

#include <functional>

#include "ods/camera/camera_preset.h"

namespace ods::cycles_camera_test {

TEST(CyclesCamera, HasItsOwnCamerasAndTheUsualOne) {
  StereoCamera usual;
  usual.top = usual.bottom = kUsualMerge;
  EXPECT_EQ(cycles_lacks(usual), "");
  EXPECT_EQ(cycles_lacks(StereoCamera()), "");
  const CameraPreset& cycles = *find_camera_preset("cycles");
  EXPECT_EQ(cycles_lacks(camera_like(cycles, {})), "");
  EXPECT_EQ(cycles_lacks(camera_like(cycles, {{"use_pole_merge", "1"}, {"convergence_mode", "TOE"}})), "");
}

TEST(CyclesCamera, LacksWhatItsEyesCannotDo) {
  const std::function<void(StereoCamera&)> kChanges[] = {
      [](StereoCamera& camera) { camera.top = kUsualMerge; },  // the bottom has none
      [](StereoCamera& camera) {
        camera.top = camera.bottom = {kMergeLinear, 60.0f, 90.0f, 1.0f};
      },
      [](StereoCamera& camera) {
        camera.top = camera.bottom = {kMergeCosine, 60.0f, 90.0f, 2.0f};
      },
      [](StereoCamera& camera) { camera.neck = 0.08f; },
      [](StereoCamera& camera) { camera.axis = vec3(0.0f, 1.0f, 0.0f); },
      [](StereoCamera& camera) { camera.head_tilt_map = std::make_shared<Image>(2, 1, 1); },
      [](StereoCamera& camera) { camera.mirrored = true; },
      [](StereoCamera& camera) { camera.convergence = kShift; },
  };
  for (const auto& change : kChanges) {
    StereoCamera camera;
    change(camera);
    EXPECT_NE(cycles_lacks(camera), "");
  }
}

TEST(CyclesCamera, RendersPartsOfLatLongOnly) {
  ProjectionSetting half;
  half.longitude = {-90.0f, 90.0f};
  EXPECT_TRUE(cycles_projects(half));
  half.kind = kFisheye;
  EXPECT_FALSE(cycles_projects(half));
  StereoCamera camera;
  camera.projection = half, camera.ipd = 0.07f;
  EXPECT_EQ(lat_long_of(camera).projection, ProjectionSetting());
  EXPECT_EQ(lat_long_of(camera).ipd, 0.07f);
}

}  // namespace ods::cycles_camera_test
