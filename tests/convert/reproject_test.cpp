// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures with depth whose eyes are moved, against the world that they are of: a ball in a box, in closed form.
#include "ods/convert/reproject.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/kernel/camera/project.h"
#include "tests/support/ball_in_box.h"

namespace ods::reproject_test {

const std::vector<int> kBoth{kLeft, kRight};
struct Result {
  double psnr = 0.0;
  double depth_off = 0.0;  // share of pixels whose depth is not within a hundredth
  double holes = 0.0;      // share of all
  double needless = 0.0;   // share of all: holes where a picture had something
};

// Returns whether the picture shows the point that the ray hits.
bool was_seen(const MadePicture& made, const Ray& ray, float depth) {
  const Camera camera = make_camera(made.picture.camera);
  const vec3 point = ray.origin + ray.direction * depth;
  for (const StoredEye& eye : made.picture.eyes) {
    const ImagePosition at = project_point(camera, eye.eye, point);
    const Seen seen = look_at_world(camera_ray(camera, eye.eye, at.uv));
    if (at.seen && std::abs(seen.depth - at.depth) < 0.02f * at.depth) return true;
  }
  return false;
}

Result convert_and_measure(const MadePicture& made, const ConvertTarget& target) {
  EXPECT_EQ(conversion_fault(made.picture, target), "");
  const Conversion conversion = convert(made.picture, target);
  EXPECT_TRUE(conversion.sees_around);
  const std::vector<Image> images = images_of(conversion.rows);
  const Camera camera = make_camera(target.camera);
  double squares = 0.0;
  int64_t filled = 0, holes = 0, off = 0, needless = 0;
  for (size_t eye = 0; eye < images.size(); eye++) {
    for (int i = 0; i < target.eye.width * target.eye.height; i++) {
      const int x = i % target.eye.width, y = i / target.eye.width;
      const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(target.eye.width),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(target.eye.height));
      const Ray ray = camera_ray(camera, target.eyes[eye], uv);
      const Seen seen = look_at_world(ray);
      const float* pixel = images[eye].at(x, y);  // R, G, B, A, Z
      if (pixel[3] == 0.0f) {
        holes++;
        needless += was_seen(made, ray, seen.depth);
        continue;
      }
      filled++;
      for (int c = 0; c < 3; c++) squares += std::pow(double{pixel[c] - seen.color[c]}, 2);
      off += std::abs(pixel[4] - seen.depth) > 0.01f * seen.depth;
    }
  }
  EXPECT_EQ(*conversion.empty, holes);
  const double all = static_cast<double>(filled + holes);
  return {-10.0 * std::log10(squares / static_cast<double>(3 * filled)), static_cast<double>(off) / all,
          static_cast<double>(holes) / all, static_cast<double>(needless) / all};
}

TEST(Reproject, NewDistanceBetweenTheEyes) {
  StereoCamera stereo;
  const MadePicture made = picture_of_world(stereo, {512, 256}, kBoth);
  for (const float ipd : {0.03f, 0.05f, 0.1f}) {
    ConvertTarget target = target_of(made, stereo.projection, made.picture.size);
    target.camera.ipd = ipd;
    const Result result = convert_and_measure(made, target);
    EXPECT_GT(result.psnr, 40.0) << ipd;
    EXPECT_LT(result.depth_off, 0.002) << ipd;
    EXPECT_LT(result.holes, 0.01) << ipd;  // most of them straight up and down, where no eye looks
    EXPECT_LT(result.needless, 0.001) << ipd;
  }
}

TEST(Reproject, NewMerge) {
  StereoCamera stereo;
  const MadePicture made = picture_of_world(stereo, {512, 256}, kBoth);
  ConvertTarget target = target_of(made, projection_named("cube-3x2"), {384, 256});
  target.camera.top.mode = kMergeCosine;
  target.camera.bottom = {kMergeSmoothstep, 30.0f, 80.0f, 1.0f};
  const Result result = convert_and_measure(made, target);
  EXPECT_GT(result.psnr, 40.0);
  EXPECT_LT(result.needless, 0.001);
}

// The camera was turned while the picture was taken.
TEST(Reproject, TurnsBackAndMovesTheEyes) {
  StereoCamera taken;
  taken.yaw = 40.0f, taken.pitch = -8.0f, taken.roll = 12.0f;
  MadePicture made = picture_of_world(taken, {512, 256}, kBoth);
  made.picture.camera.yaw = made.picture.camera.pitch = made.picture.camera.roll = 0.0f;
  ConvertTarget target = target_of(made, taken.projection, made.picture.size);
  target.turned = {taken.yaw, taken.pitch, taken.roll};
  target.camera.ipd = 0.05f;
  const Result result = convert_and_measure(made, target);
  EXPECT_GT(result.psnr, 38.0);
  EXPECT_LT(result.depth_off, 0.004);
  EXPECT_LT(result.holes, 0.01);
}

std::shared_ptr<const Image> map_of(int width, std::vector<float> values) {
  auto map = std::make_shared<Image>(width, static_cast<int>(values.size()) / width, 1);
  map->pixels = std::move(values);
  return map;
}

// The head is tilted after the fact, straightened, and tilted to another side.
TEST(Reproject, NewHeadTilt) {
  const std::shared_ptr<const Image> maps[] = {nullptr, map_of(1, {0.9f}), map_of(4, {0.2f, 0.5f, 0.6f, 0.4f})};
  for (const auto& [convergence, from] : {std::pair{kParallel, 0}, {kParallel, 1}, {kParallel, 2}, {kToeIn, 1}}) {
    StereoCamera stereo;
    stereo.convergence = convergence;
    stereo.head_tilt_map = maps[from];
    const MadePicture made = picture_of_world(stereo, {256, 128}, kBoth);
    ConvertTarget target = target_of(made, stereo.projection, made.picture.size);
    target.camera.head_tilt_map = maps[(from + 1) % 3];
    const Result result = convert_and_measure(made, target);
    EXPECT_GT(result.psnr, 36.0) << from;
    EXPECT_LT(result.depth_off, 0.006) << from;
    EXPECT_LT(result.needless, 0.001) << from;
  }
}

// Moved by nothing, everything is where it was.
TEST(Reproject, MeetsWhatThePictureShows) {
  const MadePicture made = picture_of_world(StereoCamera(), {256, 128}, kBoth);
  const Source source = make_source(made.picture);
  const Reprojection reprojection = make_reprojection(source);
  for (int i = 0; i < 256 * 128; i++) {
    const vec2 uv((static_cast<float>(i % 256) + 0.5f) / 256.0f, (static_cast<float>(i / 256) + 0.5f) / 128.0f);
    const Ray ray = camera_ray(source.camera, kLeft, uv);
    const SurfaceHit met = meet_surface(reprojection, 0, ray);
    ASSERT_TRUE(met.place.seen) << i;
    EXPECT_EQ(met.place.source_eye, 0);
    EXPECT_NEAR(met.place.at.y, uv.y * 128.0f, 0.01f);
    EXPECT_NEAR(met.depth, look_at_world(ray).depth, 1e-3f) << i;
  }
}

// Depths as others write them: nothing there, or nonsense.
TEST(Reproject, BadDepths) {
  const float bad[] = {0.0f, -1.0f, std::nanf(""), INFINITY, 1e-30f, 1e10f};
  MadePicture made = make_picture(StereoCamera(), {24, 12}, kBoth);
  add_colour(made, [](int, vec2, float* out) { out[0] = out[1] = out[2] = 0.5f; });
  add_layer<float>(made, {"Z"}, LayerRule::kNearest, SampleType::kFloat,
                   [&](int, vec2 uv, float* out) { *out = bad[static_cast<int>(uv.x * 6.0f)]; });
  ConvertTarget target = target_of(made, projection_named("eac"), {24, 16});
  target.camera.ipd = 0.2f;
  const Conversion conversion = convert(made.picture, target);
  EXPECT_EQ(conversion.no_depth, 2 * 12 * 12);  // both eyes; 0, -1 and NaN are half of each
  for (const Image& image : images_of(conversion.rows)) {
    for (const float value : image.pixels) EXPECT_FALSE(std::isnan(value));
  }
}

TEST(Reproject, TwoEyesFromOne) {
  StereoCamera stereo;
  const MadePicture made = picture_of_world(stereo, {512, 256}, {kMono});
  ConvertTarget target = target_of(made, stereo.projection, made.picture.size);
  target.eyes = kBoth;
  const Result result = convert_and_measure(made, target);
  EXPECT_GT(result.psnr, 40.0);
  EXPECT_LT(result.needless, 0.001);
  EXPECT_GT(result.holes, 0.0002);  // beside the ball
  EXPECT_LT(result.holes, 0.002);
}

}  // namespace ods::reproject_test
