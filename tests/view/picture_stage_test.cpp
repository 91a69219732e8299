// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/picture_stage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "ods/base/error.h"
#include "ods/layers/probes/harmonics.h"
#include "tests/support/stored_pictures.h"

namespace ods::picture_stage_test {

constexpr float kFloor = 1.6f, kCeiling = 1.1f, kWall = 3.0f;  // metres from the viewer
constexpr vec3 kLight(0.2f, 0.4f, 0.6f);

StereoCamera camera_of() {
  StereoCamera stereo;
  stereo.projection = projection_named("lat-long");
  stereo.position = vec3(1, 2, 3);
  stereo.yaw = 90.0f;
  return stereo;
}

// The distance along a ray from the eye, in a room of 6 m; above it is the sky, where there is no ceiling.
float distance_of(const Ray& ray, vec3 center, bool has_sky) {
  const vec3 from = ray.origin - center;
  float least = INFINITY;
  for (int i = 0; i < 3; i++) {
    const float side = i != 1 ? kWall : ray.direction.y > 0.0f ? kCeiling : kFloor;
    if (ray.direction[i] == 0.0f || (has_sky && i == 1 && ray.direction.y > 0.0f)) continue;
    least = std::min(least, (std::copysign(side, ray.direction[i]) - from[i]) / ray.direction[i]);
  }
  return has_sky && ray.direction.y > 0.4f ? kFarDepth : least;
}

MadePicture room(Extent size, bool has_sky = false) {
  MadePicture made = make_picture(camera_of(), size, {kLeft, kRight});
  add_colour(made, [](int, vec2, float* out) { out[0] = kLight.x, out[1] = kLight.y, out[2] = kLight.z; });
  const Camera camera = make_camera(made.picture.camera);
  add_layer<float>(made, {"Z"}, LayerRule::kNearest, SampleType::kFloat, [&](int eye, vec2 uv, float* out) {
    *out = distance_of(camera_ray(camera, eye, uv), camera.center, has_sky);
  });
  made.picture.is_float = true;
  return made;
}

CodeImage codes_of(const PictureStage& stage) {
  return decode_image(std::as_bytes(std::span(stage.depth_png)), "the depth");
}

TEST(PictureStage, DistancesAreExactToAThousandth) {
  const MadePicture made = room({256, 128}, true);
  const PictureStage stage = make_stage(made.picture);
  EXPECT_EQ(stage.eyes, 2);
  const CodeImage codes = codes_of(stage);
  ASSERT_EQ(codes.width, 256);
  ASSERT_EQ(codes.height, 256);
  const Camera camera = make_camera(made.picture.camera);
  for (int y = 0; y < codes.height; y++) {
    for (int x = 0; x < codes.width; x++) {
      const vec2 uv((static_cast<float>(x) + 0.5f) / 256.0f, (static_cast<float>(y % 128) + 0.5f) / 128.0f);
      const float wanted = distance_of(camera_ray(camera, y < 128 ? kLeft : kRight, uv), camera.center, true);
      const uint32_t pixel = codes.pixels[static_cast<size_t>(y * codes.width + x)];
      const float code = static_cast<float>((pixel & 255) * 256 + (pixel >> 8 & 255));
      if (wanted >= 0.1f * kFarDepth) {
        ASSERT_EQ(code, kFarCode) << x << " " << y;
      } else {
        ASSERT_NEAR(stage.nearest * std::exp2(code / stage.per_octave), wanted, 1e-4f * wanted) << x << " " << y;
      }
    }
  }
}

TEST(PictureStage, LargePicturesAreReduced) {
  const PictureStage stage = make_stage(room({2 * kMaxStageWidth, 4}).picture);
  const CodeImage codes = codes_of(stage);
  EXPECT_EQ(codes.width, kMaxStageWidth);
  EXPECT_EQ(codes.height, 4);
}

TEST(PictureStage, LightFromEverywhereIsTheZerothHarmonic) {
  const PictureStage stage = make_stage(room({256, 128}).picture);
  LightProbe probe;
  probe.radiance = stage.light;
  for (const vec3 normal : {vec3(0, 1, 0), vec3(1, 0, 0), vec3(0, 0, -1)}) {
    const vec3 got = irradiance(probe, normal) / kPi;
    for (int c = 0; c < 3; c++) EXPECT_NEAR(got[c], kLight[c], 2e-3f);
  }
}

// The sun is where the picture shows it, in the world: its middle looks along +X here.
TEST(PictureStage, LightComesFromWhereItIsSeen) {
  MadePicture made = make_picture(camera_of(), {256, 128}, {kMono});
  add_colour(made, [](int, vec2 uv, float* out) {
    out[0] = out[1] = out[2] = length(uv - vec2(0.5f, 0.5f)) < 0.05f ? 100.0f : 0.0f;
  });
  add_layer<float>(made, {"Z"}, LayerRule::kNearest, SampleType::kFloat, [](int, vec2, float* out) { *out = 2.0f; });
  made.picture.is_float = true;
  const PictureStage stage = make_stage(made.picture);
  const vec3 first(stage.light[3].x, stage.light[1].x, stage.light[2].x);  // x, y, z
  EXPECT_GT(dot(normalize(first), vec3(1, 0, 0)), 0.999f);
}

TEST(PictureStage, ObjectsBeginOnTheFloorAhead) {
  const PictureStage stage = make_stage(room({512, 256}).picture);
  const vec3 wanted(1.0f + 1.2f, 2.0f - kFloor, 3.0f);
  for (int i = 0; i < 3; i++) EXPECT_NEAR(stage.ahead[i], wanted[i], 0.02f) << i;
}

TEST(PictureStage, NeedsDepth) {
  MadePicture made = make_picture(camera_of(), {16, 8}, {kMono});
  add_colour(made, [](int, vec2, float* out) { out[0] = out[1] = out[2] = 0.5f; });
  EXPECT_THROW(make_stage(made.picture), Error);
}

TEST(PictureStage, JsonHasThePoseOfTheCamera) {
  const PictureStage stage = make_stage(room({64, 32}).picture);
  const Json json = stage_json(stage, camera_of(), "item/0/depth.png");
  EXPECT_EQ(json["center"], Json::parse("[1, 2, 3]"));
  EXPECT_EQ(json["light"].size(), 27u);
  EXPECT_NEAR(json["frame"][2][0].get<float>(), -1.0f, 1e-6f) << "its back";
}

}  // namespace ods::picture_stage_test
