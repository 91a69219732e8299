// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/light/sky.h"

#include <gtest/gtest.h>

#include "ods/render/cpu/render.h"
#include "ods/render/render_target.h"
#include "tests/support/pictures.h"
#include "tests/support/texels.h"

namespace ods::sky_test {

// The texels of a square of this width at a distance of 1 in front of the viewer.
TexelRays window(float width, int texels) {
  TexelRays rays = empty_texels(texels, texels);
  const float step = width / static_cast<float>(texels);
  for (int i = 0; i < texels * texels; i++) {
    const float x = (static_cast<float>(i % texels) + 0.5f) * step - 0.5f * width;
    const float y = 0.5f * width - (static_cast<float>(i / texels) + 0.5f) * step;
    TexelRay& ray = rays.rays[static_cast<size_t>(i)];
    ray.direction = normalize(vec3(x, y, -1.0f));
    ray.across = vec3(step, 0, 0), ray.down = vec3(0, -step, 0);
  }
  return rays;
}

// Vertical stripes, one texel wide, 1 and 0 in turn; red is 1 everywhere.
Environment stripes(int width) {
  Environment sky{vec3(1.0f), width, width / 2, {}};
  for (int i = 0; i < width * width / 2; i++) sky.texels.emplace_back(1.0f, i % 2, 0.0f);
  return sky;
}

TEST(Sky, IsWhatTheCameraSees) {
  Scene scene;
  scene.environment.radiance = vec3(0.25f);
  const TexelRays rays = window(0.5f, 4);
  for (const float light : sky_of(scene, rays).pixels) EXPECT_EQ(light, 0.25f);
  scene.background.emplace().radiance = vec3(0.5f);
  for (const float light : sky_of(scene, rays).pixels) EXPECT_EQ(light, 0.5f);
}

// Small texels, each within a texel of the environment: as rendered, which is a mean over no angle at all.
TEST(Sky, SmallTexelsAreSharp) {
  Scene scene;
  scene.environment = stripes(64);
  const TexelRays rays = window(0.4f, 48);
  RenderOptions options = with_texels(small_render(1, 1), 48, 48);
  const Picture seen = render_cpu(scene, camera_of(rays), options);
  const Image sky = sky_of(scene, rays);
  for (size_t i = 0; i < sky.pixels.size(); i++) EXPECT_NEAR(sky.pixels[i], seen.eyes[0].radiance.pixels[i], 1e-5f);
}

// Stripes far narrower than texels are grey, without a pattern.
TEST(Sky, ALargeEnvironmentDoesNotAlias) {
  Scene scene;
  scene.environment = stripes(1024);
  const Image sky = sky_of(scene, window(1.0f, 16));
  for (size_t i = 0; i < sky.pixels.size(); i += 3) {
    EXPECT_NEAR(sky.pixels[i], 1.0f, 1e-5f);
    EXPECT_NEAR(sky.pixels[i + 1], 0.5f, 0.06f);
  }
}

TEST(Sky, EmptyTexelsAreBlack) {
  Scene scene;
  scene.environment.radiance = vec3(1.0f);
  for (const float light : sky_of(scene, empty_texels(3, 2)).pixels) EXPECT_EQ(light, 0.0f);
}

}  // namespace ods::sky_test
