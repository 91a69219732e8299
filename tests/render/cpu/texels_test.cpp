// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures of texel_camera(): their rays come from a table.
#include "tests/support/texels.h"

#include <gtest/gtest.h>

#include "ods/render/cpu/render.h"
#include "ods/render/render_target.h"
#include "tests/render/gpu/agreement.h"
#include "tests/support/pictures.h"

namespace ods::texels_test {

constexpr int kWide = 64, kHigh = 32;

RenderOptions texel_options(int width, int height, int samples) {
  RenderOptions options = with_texels({}, width, height);
  options.samples = samples;
  options.statistics = true;
  return options;
}

// A box with a lamp behind the viewer: on its walls light varies slowly.
Scene smooth_box() {
  Scene scene;
  add_box(scene, vec3(-1.5f, -1.0f, -2.0f), vec3(1.5f, 1.2f, 2.0f), add_material(scene, matte(vec3(0.7f, 0.5f, 0.3f))));
  add_sphere(scene, vec3(0.3f, 0.5f, 1.4f), 0.2f, add_material(scene, glow(vec3(4, 3, 2))), 12);
  return scene;
}

TEST(Texels, RaysOfACameraGiveItsPicture) {
  const Scene scene = smooth_box();
  StereoCamera camera;
  camera.ipd = 0.0f;
  camera.yaw = 10.0f;
  camera.projection.kind = kPerspective;
  camera.projection.fov = 80.0f;
  camera.projection.aspect = 2.0f;
  const RenderOptions options = texel_options(kWide, kHigh, 32);
  RenderOptions even = options;
  even.even_noise = false;
  const CpuRenderer renderer(scene);
  const PictureSamples usual = sampled(renderer, camera, even);
  const PictureSamples texels = sampled(renderer, camera_of(texels_of(camera, kWide, kHigh)), options);
  EXPECT_EQ(texels.eyes[0].depth, usual.eyes[0].depth);  // of the same rays
  EXPECT_EQ(texels.eyes[0].count, usual.eyes[0].count);  // even noise does not apply
  for (const double z : z_of_blocks(usual, texels)) EXPECT_LT(std::abs(z), 4.5);
}

// A square whose right half glows, 1 in red, and whose lower half glows, 1 in green.
Scene quarters() {
  Scene scene;
  for (int i = 0; i < 4; i++) {
    const vec3 light(i % 2 == 1 ? 1.0f : 0.0f, i / 2 == 1 ? 1.0f : 0.0f, 0.0f);
    const vec3 corner(static_cast<float>(i % 2) - 1.0f, static_cast<float>(-(i / 2)), -1.0f);
    add_rectangle(scene, corner, vec3(1, 0, 0), vec3(0, 1, 0), add_material(scene, glow(light)));
  }
  return scene;
}

// Radiance of a texture on a scene.
Image light_on(const Scene& scene, const TexelRays& texels, int samples) {
  return render_cpu(scene, camera_of(texels), texel_options(texels.width, texels.height, samples)).eyes[0].radiance;
}

TEST(Texels, CoverTheirAreaEvenly) {
  const Scene scene = quarters();
  const TexelRays texels = texels_on(vec3(-0.7f, 0.6f, -1), vec3(1, 0, 0), vec3(0, -1, 0), 1, 1);
  const Image light = light_on(scene, texels, 256);
  EXPECT_NEAR(light.pixels[0], 0.3f, 0.01f);  // the square begins at x = -0.7: 0.3 of it are right of 0
  EXPECT_NEAR(light.pixels[1], 0.4f, 0.01f);
  TexelRays points = texels;
  points.rays[0].across = points.rays[0].down = vec3(0.0f);
  const Image middle = light_on(scene, points, 16);  // at -0.2, 0.1
  EXPECT_EQ(middle.pixels[0], 0.0f);
  EXPECT_EQ(middle.pixels[1], 0.0f);
}

TEST(Texels, AreInOrder) {
  const Image light = light_on(quarters(), texels_on(vec3(-1, 1, -1), vec3(2, 0, 0), vec3(0, -2, 0), 4, 2), 1);
  for (int i = 0; i < 8; i++) {
    EXPECT_EQ(light.at(i % 4, i / 4)[0], i % 4 >= 2 ? 1.0f : 0.0f) << i;
    EXPECT_EQ(light.at(i % 4, i / 4)[1], i >= 4 ? 1.0f : 0.0f) << i;
  }
}

TEST(Texels, EmptyOnesAreEmpty) {
  Scene scene = smooth_box();
  TexelRays texels = texels_of(StereoCamera{}, kWide, kHigh);
  for (size_t i = 0; i < texels.rays.size(); i += 3) texels.rays[i].direction = vec3(0.0f);
  const Picture picture = render_cpu(scene, camera_of(texels), texel_options(kWide, kHigh, 16));
  const EyeImage& eye = picture.eyes[0];
  for (size_t i = 0; i < texels.rays.size(); i++) {
    const bool is_empty = i % 3 == 0;
    ASSERT_EQ(eye.depth.pixels[i] == kFarDepth, is_empty) << i;
    const vec3 light(eye.radiance.pixels[3 * i], eye.radiance.pixels[3 * i + 1], eye.radiance.pixels[3 * i + 2]);
    ASSERT_EQ(light == vec3(0.0f), is_empty) << i;
  }
}

// The light cache is filled from texels.
TEST(Texels, HaveALightCache) {
  const Scene scene = smooth_box();
  const CpuRenderer renderer(scene);
  const StereoCamera camera = camera_of(texels_of(StereoCamera{}, kWide, kHigh));
  RenderOptions options = texel_options(kWide, kHigh, 16);
  const Mean paths = mean_of(renderer.render(camera, options).eyes[0].radiance);
  options.indirect = Indirect::kCache;
  options.cache_paths = 1 << 14;
  EXPECT_FALSE(renderer.fill_cells({&camera, 1}, options).table.empty());
  EXPECT_NEAR(mean_of(renderer.render(camera, options).eyes[0].radiance).value(), paths.value(), 0.02 * paths.value());
}

}  // namespace ods::texels_test
