// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Views as other programs leave them on the disk, made here by those programs' own geometry: a rig of fixed options and
// a pattern put them together. docs/slits.md has the commands.
#include <gtest/gtest.h>

#include <cmath>

#include "ods/stitch/view_files.h"
#include "tests/support/stored_pictures.h"
#include "tests/support/temporary_folder.h"

namespace ods::foreign_views_test {

// Smooth colours on a ball of 2 m around the eyes, seen from within.
vec3 colour(vec3 from, vec3 direction) {
  const float along = dot(from, direction);
  const vec3 p = from + direction * (std::sqrt(along * along - dot(from, from) + 4.0f) - along);
  return 0.5f + 0.4f * vec3(std::sin(3.0f * p.x + 2.0f * p.y), std::sin(4.0f * p.y), std::sin(3.0f * p.z));
}

// Unreal's Stereo Panoramic Capture, with SP.GenerateDebugImages 1, of defaults but for its sizes. A step of yaw is a
// column, from behind to the right; in it are the strips of three pitches, straight up, level, straight down. Every
// strip is the middle of a square capture of 90 degrees. Source: the plug-in's
// SceneCapturer.cpp.
struct UnrealCapture {
  int steps;         // SP.HorizontalAngularIncrement is 360 / steps degrees
  int capture;       // SP.CaptureSlicePixelWidth
  float separation;  // SP.EyeSeparation, metres
  Extent strip() const {
    const int wide = static_cast<int>(static_cast<float>(capture) * std::tan(kPi / static_cast<float>(steps)));
    return {wide + wide % 2, capture};
  }
};

// Eye: -1 left, 1 right.
vec3 unreal_pixel(const UnrealCapture& unreal, float eye, int x, int y) {
  const Extent strip = unreal.strip();
  const float yaw = kPi + 2.0f * kPi * static_cast<float>(x / strip.width) / static_cast<float>(unreal.steps);
  const float pitch = 0.5f * kPi * static_cast<float>(1 - y / strip.height);
  const vec3 level(std::sin(yaw), 0.0f, -std::cos(yaw)), right(std::cos(yaw), 0.0f, std::sin(yaw)), up(0, 1, 0);
  const vec3 ahead = std::cos(pitch) * level + std::sin(pitch) * up;
  const vec3 above = std::cos(pitch) * up - std::sin(pitch) * level;
  const float half = 0.5f * static_cast<float>(unreal.capture);
  const float across = (static_cast<float>(x % strip.width) + 0.5f - 0.5f * static_cast<float>(strip.width)) / half;
  const float down = (static_cast<float>(y % strip.height) + 0.5f) / half - 1.0f;
  return colour(0.5f * eye * unreal.separation * right, normalize(ahead + across * right - down * above));
}

void write_unreal_sheet(const UnrealCapture& unreal, float eye, const std::string& path) {
  PictureRows rows;
  rows.eye = {unreal.strip().width * unreal.steps, 3 * unreal.strip().height};
  rows.eyes = {kMono}, rows.layers = {{{"R", "G", "B"}}};
  rows.fill = [&](int, int y, std::span<float> row) {
    for (int x = 0; x < rows.eye.width; x++) {
      const vec3 pixel = unreal_pixel(unreal, eye, x, y);
      for (int c = 0; c < 3; c++) row[static_cast<size_t>(3 * x + c)] = pixel[c];
    }
  };
  SaveOptions save;
  save.tone = ToneCurve::kLinear;
  save_picture(rows, nullptr, save, path);
}

// --width W --slits STEPS --pitches 3 --caps --blend 0 --padding 0 --yaw (half a step to the left) --scale (a hair less
// than pi capture / W: in its corners a slit of ours is a hair higher than a strip of theirs)
SlitRig unreal_rig(const UnrealCapture& unreal, Extent eye, float yaw, float scale) {
  SlitOptions options;
  options.slits = unreal.steps, options.pitches = 3, options.caps = true;
  options.blend = 0.0f, options.padding = 0, options.scale = scale;
  StereoCamera camera;
  camera.ipd = unreal.separation, camera.yaw = yaw;
  EXPECT_EQ(slit_fault(camera, eye, options), "");
  return make_slit_rig(camera, eye, {kLeft, kRight}, options);
}

double psnr(const SlitRig& rig, const Stitched& stitched) {
  const Camera camera = make_camera(rig.camera);
  const std::vector<Image> images = images_of(stitched.rows);
  double sum = 0.0;
  for (size_t eye = 0; eye < 2; eye++) {
    for (int y = 0; y < rig.eye.height; y++) {
      for (int x = 0; x < rig.eye.width; x++) {
        const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(rig.eye.width),
                      (static_cast<float>(y) + 0.5f) / static_cast<float>(rig.eye.height));
        const Ray ray = camera_ray(camera, rig.eyes[eye], uv);
        const vec3 exact = colour(ray.origin, ray.direction);
        for (int c = 0; c < 3; c++) sum += std::pow(static_cast<double>(images[eye].at(x, y)[c] - exact[c]), 2.0);
      }
    }
  }
  return -10.0 * std::log10(sum / (6.0 * rig.eye.width * rig.eye.height));
}

TEST(ForeignViews, UnrealsDebugSheets) {
  const UnrealCapture unreal{120, 144, 0.064f};
  const TemporaryFolder folder;
  write_unreal_sheet(unreal, -1.0f, folder.path("left.1.png"));
  write_unreal_sheet(unreal, 1.0f, folder.path("right.1.png"));
  const ViewFiles files{folder.path("%V.#.png"), unreal.steps, 3, true};
  const auto quality = [&](float yaw) {
    const SlitRig rig = unreal_rig(unreal, {256, 128}, yaw, 0.9996f * kPi * 144.0f / 256.0f);
    EXPECT_EQ(names_fault(rig, files), "");
    EXPECT_TRUE(missing_views(rig, files, true).empty());
    const Stitched stitched = stitch(rig, open_view_files(rig, files), {});
    EXPECT_TRUE(stitched.faults.empty());
    return psnr(rig, stitched);
  };
  const double right = quality(-1.5f);
  EXPECT_GT(right, 45.0);
  EXPECT_LT(quality(0.0f), right - 10.0);  // its first column is straight behind, not half a step beside
}

// The plug-in's default capture, and the numbers for it in docs/slits.md.
TEST(ForeignViews, UnrealsDefaultsAreTheDocumentedRig) {
  const UnrealCapture unreal{360, 2048, 0.064f};
  EXPECT_EQ(unreal.strip().width, 18);
  const SlitRig rig = unreal_rig(unreal, {4096, 2048}, -0.5f, 1.5707f);
  EXPECT_EQ(rig.view.width, unreal.strip().width);
  EXPECT_EQ(rig.view.height, unreal.strip().height);
}

// Views of a wall that faces one way, as their own axes have it.
TEST(ForeignViews, NormalsOfViewsBecomeTheWorlds) {
  const TemporaryFolder folder;
  SlitOptions options;
  options.slits = 8;
  const SlitRig rig = make_slit_rig(StereoCamera(), {64, 32}, {kLeft, kRight}, options);
  ViewFiles files{folder.path("##.exr")};
  const vec3 normal(0.6f, 0.0f, -0.8f);
  for (const SampleType sample : {SampleType::kHalf, SampleType::kFloat}) {
    for (size_t i = 0; i < rig.views.size(); i++) {
      PictureRows rows;
      rows.eye = rig.view, rows.eyes = {kMono};
      rows.layers = {{{"R", "G", "B"}, LayerRule::kLight, SampleType::kHalf},
                     {{"wall.Normal.X", "wall.Normal.Y", "wall.Normal.Z"}, LayerRule::kMean, sample}};
      const Camera view = make_camera(rig.views[i]);
      const float pixel[] = {0.5f, 0.5f, 0.5f, dot(normal, view.right), dot(normal, view.up), dot(normal, view.back)};
      rows.fill = [&](int, int, std::span<float> row) {
        for (size_t k = 0; k < row.size(); k++) row[k] = pixel[k % 6];
      };
      save_picture(rows, nullptr, {}, view_path(rig, files, i));
    }
    for (const bool own : {false, true}) {
      files.own_normals = own;
      const Stitched stitched = stitch(rig, open_view_files(rig, files), {});
      ASSERT_TRUE(stitched.faults.empty());
      std::vector<float> row(64 * 6);
      float off = 0.0f;
      for (int y = 0; y < 32; y++) {
        stitched.rows.fill(1, y, row);
        for (size_t i = 0; i < row.size(); i++) {
          if (i % 6 >= 3) off = std::max(off, std::abs(row[i] - normal[static_cast<int>(i % 3)]));
        }
      }
      EXPECT_EQ(off < 2e-3f, own) << off;
    }
  }
}

}  // namespace ods::foreign_views_test
