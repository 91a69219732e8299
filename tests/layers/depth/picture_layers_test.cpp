// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/depth/picture_layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ods/base/error.h"
#include "ods/layers/as_scene.h"
#include "ods/layers/layer_views.h"
#include "ods/layers/probes/harmonics.h"
#include "ods/layers/visibility.h"
#include "tests/support/ball_in_box.h"

namespace ods::picture_layers_test {

PictureLayersOptions small(float box) {
  PictureLayersOptions options;
  options.box = vec3(box);
  options.width = 1024;
  options.tone = ToneCurve::kLinear;
  return options;
}

// The share of rays from other eyes whose layer is where the world is: for eyes in a box of 0.3 m, within a pixel.
double share_right(const LayeredScene& layers) {
  const LayerViews views(layers);
  LayeredScene surfaces = layers;
  std::erase_if(surfaces.meshes, [](const LayerMesh& mesh) { return mesh.kind == LayerKind::kSky; });
  const Scene scene = as_scene(surfaces);
  const FirstHits hits(scene);
  const LayerViews::View view = views.from_eye(5);
  std::vector<FirstHit> seen(view.directions.size());
  hits.look(view.place, view.directions.data(), static_cast<int>(seen.size()), seen.data());
  size_t right = 0;
  for (size_t i = 0; i < seen.size(); i++) {
    const float depth = look_at_world({view.place, view.directions[i]}).depth;
    right += 0.26f * std::abs(1.0f / seen[i].distance - 1.0f / depth) < pixel_angle(layers.width) ? 1 : 0;
  }
  return static_cast<double>(right) / static_cast<double>(seen.size());
}

TEST(PictureLayers, AreWhereTheWorldIs) {
  for (const bool is_stereo : {false, true}) {
    StereoCamera camera;
    camera.yaw = 30.0f;
    const std::vector<int> eyes = is_stereo ? std::vector<int>{kLeft, kRight} : std::vector<int>{kMono};
    PictureLayersCounts counts;
    const LayeredScene layers =
        picture_layers(picture_of_world(camera, {1024, 512}, eyes).picture, small(0.3f), &counts);
    EXPECT_GT(share_right(layers), 0.98);
    EXPECT_EQ(layers.yaw, 30.0f);
    // The mean over the eyes of what the ball hides from the middle and not from them: in the order of the ball's
    // outline times the mean parallax.
    EXPECT_GT(counts.hidden, 0.0005);
    EXPECT_LT(counts.hidden, 0.01);
    EXPECT_LT(counts.open, 0.002);
    EXPECT_LT(counts.triangles, 100000u);
  }
}

TEST(PictureLayers, AreLitByTheWholePicture) {
  const LayeredScene layers =
      picture_layers(picture_of_world(StereoCamera(), {512, 256}, {kMono}).picture, small(0.2f));
  ASSERT_EQ(layers.light.probes.probes.size(), 1u);
  // The world's red is a tenth but for the ball, which fills sin^2(r / 2) of the sphere.
  const float angle = std::asin(kRadius / length(kBall)), ball = std::pow(std::sin(0.5f * angle), 2.0f);
  const vec3 mean = layers.light.probes.probes[0].radiance[0] / (0.28209479f * 4.0f * 3.14159265f);
  EXPECT_NEAR(mean.x, 0.1f + 0.8f * ball, 0.003f);
}

TEST(PictureLayers, NeedDepthAndRoom) {
  MadePicture flat = make_picture(StereoCamera(), {256, 128}, {kMono});
  add_colour(flat, [](int, vec2, float* out) { std::fill(out, out + 3, 0.5f); });
  EXPECT_THROW(picture_layers(flat.picture, small(0.3f)), Error);
  const MadePicture made = picture_of_world(StereoCamera(), {512, 256}, {kMono});
  try {
    picture_layers(made.picture, small(2.0f));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_NE(std::string(error.what()).find("`box` of at most 1."), std::string::npos) << error.what();
  }
}

TEST(PictureLayers, AreCancelled) {
  const MadePicture made = picture_of_world(StereoCamera(), {256, 128}, {kMono});
  const Progress progress{{}, [] { return true; }};
  EXPECT_THROW(picture_layers(made.picture, small(0.3f), nullptr, progress), Error);
}

}  // namespace ods::picture_layers_test
