// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/cycles_camera.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <vector>

#include "ods/camera/camera_preset.h"
#include "ods/kernel/camera/camera.h"

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
      [](StereoCamera& camera) {
        camera.top = camera.bottom = {kMergeMap, 60.0f, 90.0f, 1.0f};
        Image map(2, 1, 1);
        map.pixels = {0.0f, 1.0f};
        camera.merge_map = std::make_shared<Image>(map);
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

TEST(CyclesCamera, ItsOwnMergeIsOneBand) {
  StereoCamera usual;
  usual.top = usual.bottom = kUsualMerge;
  const std::vector<CyclesBand> bands = cycles_bands(usual, 512);
  ASSERT_EQ(bands.size(), 1u);
  EXPECT_EQ(bands[0].rows, 512);
  EXPECT_TRUE(bands[0].camera == usual);
}

// In each row the rays of its band start where the camera's do, within a quarter of a pixel at 1 m, and look alike.
TEST(CyclesCamera, OtherMergesAreBandsWithTheCamerasRays) {
  StereoCamera changes[3];
  changes[0].top = kUsualMerge;  // the bottom has none
  changes[1].top = changes[1].bottom = {kMergeLinear, 45.0f, 90.0f, 1.0f};
  changes[2].top = changes[2].bottom = {kMergeCosine, 30.0f, 90.0f, 2.0f};
  changes[2].projection.latitude = {-60.0f, 75.0f};
  changes[2].pitch = 20.0f, changes[2].convergence = kToeIn;
  constexpr int kHeight = 700;
  for (const StereoCamera& stereo : changes) {
    const Camera camera = make_camera(stereo);
    const vec2 range = stereo.projection.latitude;
    const float most = 0.26f * glm::radians(range.y - range.x) / kHeight;
    int row = 0;
    for (const CyclesBand& band : cycles_bands(stereo, kHeight)) {
      EXPECT_EQ(band.first, row);
      EXPECT_GE(band.rows, kLeastBand);
      const Camera own = make_camera(band.camera);
      for (int y = 0; y < band.rows; y++, row++) {
        const auto middle = [](int number, int all) { return (float(number) + 0.5f) / float(all); };
        const Ray ray = camera_ray(camera, kRight, vec2(0.3f, middle(row, kHeight)));
        const Ray other = camera_ray(own, kRight, vec2(0.3f, middle(y, band.rows)));
        EXPECT_LT(length(ray.origin - other.origin), most) << row;
        EXPECT_LT(length(ray.direction - other.direction), most) << row;
      }
    }
    EXPECT_EQ(row, kHeight);
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
