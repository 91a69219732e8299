// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scene::background: what the camera sees behind the scene, which lights nothing.
#include <gtest/gtest.h>

#include "ods/render/cpu/render.h"
#include "tests/support/pictures.h"

namespace ods {
namespace {

Environment even(vec3 radiance) {
  Environment environment;
  environment.radiance = radiance;
  return environment;
}

vec3 pixel(const Picture& picture, int x, int y) {
  const float* p = picture.eyes[0].radiance.at(x, y);
  return {p[0], p[1], p[2]};
}

// A white square before the camera, in white light; the rest of the sphere is empty.
Scene square(const Material& material) {
  Scene scene;
  scene.environment = even(vec3(1.0f));
  add_rectangle(scene, vec3(-1, -1, -2), vec3(2, 0, 0), vec3(0, 2, 0), add_material(scene, material));
  return scene;
}

TEST(Background, IsSeenBehindAndLightsNothing) {
  Scene scene = square(matte(vec3(0.5f)));
  const RenderOptions options = small_render(64, 4);
  const Picture before = render_cpu(scene, {}, options);
  scene.background = even(vec3(0.125f, 0.25f, 0.375f));
  const Picture after = render_cpu(scene, {}, options);
  EXPECT_EQ(pixel(before, 2, 16), vec3(1.0f));
  EXPECT_EQ(pixel(before, 32, 16), vec3(0.5f));
  EXPECT_EQ(pixel(after, 2, 16), vec3(0.125f, 0.25f, 0.375f));
  EXPECT_EQ(pixel(after, 32, 16), vec3(0.5f));
}

TEST(Background, MirrorsShowTheEnvironment) {
  Scene scene = square(metal(vec3(1.0f), 0.0f));
  scene.background = even(vec3(0.0f));
  const Picture picture = render_cpu(scene, {}, small_render(64, 4));
  EXPECT_NEAR(pixel(picture, 32, 16).g, 1.0f, 1e-3f);
  EXPECT_EQ(pixel(picture, 2, 16), vec3(0.0f));
}

TEST(Background, IsSeenThroughWhatIsCutOut) {
  Material veil = matte(vec3(1.0f));
  veil.alpha_mode = kAlphaMask;
  veil.base_color.w = 0.0f;
  Scene scene = square(veil);
  scene.background = even(vec3(0.25f));
  EXPECT_EQ(pixel(render_cpu(scene, {}, small_render(64, 4)), 32, 16), vec3(0.25f));
}

// Its texels stand behind the environment's, and its factor counts.
TEST(Background, PictureBesideAPictureOfTheEnvironment) {
  Scene scene = square(matte(vec3(0.5f)));
  scene.environment = make_environment(16, [](vec3) { return vec3(1.0f); });
  const RenderOptions options = small_render(64, 64);
  const Picture before = render_cpu(scene, {}, options);
  scene.background =
      make_environment(32, [](vec3 d) { return d.y > 0.0f ? vec3(0.125f, 0.0f, 0.0f) : vec3(0.0f, 0.25f, 0.0f); });
  scene.background->radiance = vec3(2.0f);
  const Picture after = render_cpu(scene, {}, options);
  EXPECT_EQ(pixel(after, 32, 16), pixel(before, 32, 16)) << "lit as before, to the bit";
  EXPECT_EQ(pixel(after, 2, 2), vec3(0.25f, 0.0f, 0.0f));
  EXPECT_EQ(pixel(after, 2, 29), vec3(0.0f, 0.5f, 0.0f));
}

TEST(Background, TransparentPicturesHaveNone) {
  Scene scene = square(matte(vec3(0.5f)));
  scene.background = even(vec3(0.25f));
  RenderOptions options = small_render(64, 4);
  options.transparent = true;
  EXPECT_EQ(pixel(render_cpu(scene, {}, options), 2, 16), vec3(0.0f));
}

}  // namespace
}  // namespace ods
