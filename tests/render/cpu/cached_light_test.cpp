// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures whose indirect light comes out of a cache.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ods/render/cpu/render.h"
#include "ods/render/picture_samples.h"
#include "ods/render/render_target.h"
#include "tests/support/pictures.h"

namespace ods {
namespace {

Material painted(vec3 albedo, vec3 emission = vec3(0.0f)) {
  Material material = default_material();
  material.base_color = vec4(albedo, 1.0f);
  material.emission = emission;
  material.ior = 1.0f;
  material.double_sided = 1;
  return material;
}

RenderOptions cached(int width, int samples) {
  RenderOptions options = small_render(width, samples);
  options.indirect = Indirect::kCache;
  options.cache_paths = 1 << 16;
  return options;
}

double mean_over_eyes(const Picture& picture, int channel) {
  double sum = 0.0;
  size_t count = 0;
  for (const EyeImage& eye : picture.eyes) {
    for (size_t i = 0; i < eye.radiance.pixels.size(); i += 3, count++) {
      sum += double{eye.radiance.pixels[i + static_cast<size_t>(channel)]};
    }
  }
  return sum / static_cast<double>(count);
}

// All walls glow and reflect: after b bounces the light is the sum of b + 1 terms, whatever cached it.
TEST(CachedLight, GlowingBoxHasEveryBounce) {
  for (const int bounces : {2, 3, 8}) {
    Scene scene;
    const vec3 albedo(0.5f, 0.7f, 0.2f);
    add_box(scene, vec3(-2, -1, -3), vec3(2, 1.5f, 3), add_material(scene, painted(albedo, vec3(1.0f))));
    RenderOptions options = cached(32, 16);
    options.bounces = bounces;
    const Picture picture = render_cpu(scene, StereoCamera{}, options);
    for (int c = 0; c < 3; c++) {
      double expected = 0.0;
      for (int b = 0; b <= bounces; b++) expected += std::pow(double{albedo[c]}, b);
      EXPECT_NEAR(mean_over_eyes(picture, c) / expected, 1.0, 5e-3) << bounces << " bounces, channel " << c;
    }
  }
}

// A room with a lamp behind a screen: most light is indirect. A shelf and a pillar are closer than a cell.
Scene room() {
  Scene scene;
  const int white = add_material(scene, painted(vec3(0.8f)));
  const int red = add_material(scene, painted(vec3(0.7f, 0.2f, 0.1f)));
  const int lamp = add_material(scene, painted(vec3(0.0f), vec3(40.0f)));
  add_box(scene, vec3(-3, -1.2f, -3), vec3(3, 1.4f, 3), white);
  add_box(scene, vec3(-2.9f, 0.2f, -1), vec3(-2.6f, 0.24f, 1), red);
  add_box(scene, vec3(1, -1.2f, -2), vec3(1.1f, 1.4f, -1.9f), red);
  add_rectangle(scene, vec3(-0.4f, 1.0f, -2.6f), vec3(0.8f, 0, 0), vec3(0, 0, 0.8f), lamp);
  add_rectangle(scene, vec3(-0.6f, 0.9f, -2.7f), vec3(1.2f, 0, 0), vec3(0, 0, 1.2f), white);
  return scene;
}

TEST(CachedLight, AgreesWithPaths) {
  const Scene scene = room();
  RenderOptions options = cached(64, 64);
  options.cache_paths = 1 << 18;
  const Picture fast = render_cpu(scene, StereoCamera{}, options);
  options.indirect = Indirect::kPath;
  const Picture exact = render_cpu(scene, StereoCamera{}, options);
  for (int c = 0; c < 3; c++) EXPECT_NEAR(mean_over_eyes(fast, c) / mean_over_eyes(exact, c), 1.0, 0.01);
  // Blocks of 16x16 pixels: noise and cache together.
  for (int y = 0; y < 32; y += 16) {
    for (int x = 0; x < 64; x += 16) {
      double a = 0.0, b = 0.0;
      for (int i = 0; i < 256; i++) {
        a += double{fast.eyes[0].radiance.at(x + i % 16, y + i / 16)[1]};
        b += double{exact.eyes[0].radiance.at(x + i % 16, y + i / 16)[1]};
      }
      EXPECT_NEAR(a / b, 1.0, 0.09) << x << "," << y;
    }
  }
}

TEST(CachedLight, IsLessNoisy) {
  const Scene scene = room();
  RenderOptions options = cached(64, 32);
  options.statistics = true;
  const Picture fast = render_cpu(scene, StereoCamera{}, options);
  options.indirect = Indirect::kPath;
  const Picture exact = render_cpu(scene, StereoCamera{}, options);
  EXPECT_LT(mean_of(fast.eyes[0].variance).value(), 0.5 * mean_of(exact.eyes[0].variance).value());
}

// A dark room beside a bright one, behind a wall thinner than a cell.
TEST(CachedLight, StaysOnItsSideOfAWall) {
  Scene scene;
  const int white = add_material(scene, painted(vec3(0.8f)));
  const int lamp = add_material(scene, painted(vec3(0.0f), vec3(100.0f)));
  add_box(scene, vec3(-3, -1.2f, -3), vec3(3, 1.4f, 3), white);
  add_box(scene, vec3(3.05f, -1.2f, -3), vec3(6, 1.4f, 3), white);
  add_rectangle(scene, vec3(4, 1.3f, -0.5f), vec3(1, 0, 0), vec3(0, 0, 1), lamp);
  const Picture dark = render_cpu(scene, StereoCamera{}, cached(64, 16));
  for (const float value : dark.eyes[0].radiance.pixels) ASSERT_EQ(value, 0.0f);
  // A door: the camera now sees both, and cells of both rooms are filled.
  Scene open = scene;
  StereoCamera camera;
  camera.position = vec3(2.9f, 0.0f, 0.0f);
  const Picture near_wall = render_cpu(scene, camera, cached(64, 16));
  for (const float value : near_wall.eyes[0].radiance.pixels) ASSERT_EQ(value, 0.0f);
}

// The cells are the same whatever part of the samples is rendered, and whenever.
TEST(CachedLight, ResumedAndInParts) {
  const Scene scene = room();
  RenderOptions options = cached(32, 16);
  options.cache_paths = 1 << 14;
  options = with_height(options, StereoCamera{});
  const CpuRenderer renderer(scene);
  const StereoCamera camera;
  PictureSamples whole = no_samples(options);
  renderer.sample({&camera, 1}, options, whole);
  std::vector<int64_t> sum(whole.eyes[0].light.size());
  for (int part = 1; part <= 4; part++) {
    RenderOptions share = options;
    share.part = {part, 4};
    PictureSamples samples = no_samples(share);
    renderer.sample({&camera, 1}, share, samples);
    for (size_t i = 0; i < sum.size(); i++) sum[i] += samples.eyes[0].light[i];
  }
  EXPECT_EQ(sum, whole.eyes[0].light);
}

// Lamps of no size and of a million times the usual light, a tiny room, one in a landscape: every pixel is a number,
// and no brighter than what paths find.
TEST(CachedLight, StrangeScenesAreFinite) {
  for (const float scale : {1e-3f, 1.0f, 300.0f}) {
    Scene scene;
    const int white = add_material(scene, painted(vec3(0.8f)));
    const int lamp = add_material(scene, painted(vec3(0.0f), vec3(1e6f)));
    add_box(scene, vec3(-3, -1.2f, -3) * scale, vec3(3, 1.4f, 3) * scale, white);
    add_rectangle(scene, vec3(-0.1f, 1.3f, -2) * scale, vec3(0.2f, 0, 0) * scale, vec3(0, 0, 0.2f) * scale, lamp);
    add_rectangle(scene, vec3(0, 1, 0) * scale, vec3(0.2f, 0, 0) * scale, vec3(0.2f, 0, 0) * scale, lamp);
    RenderOptions options = cached(32, 16);
    const Picture fast = render_cpu(scene, StereoCamera{}, options);
    options.indirect = Indirect::kPath;
    const Picture exact = render_cpu(scene, StereoCamera{}, options);
    for (const float value : fast.eyes[0].radiance.pixels) ASSERT_TRUE(std::isfinite(value));
    EXPECT_NEAR(mean_over_eyes(fast, 1) / mean_over_eyes(exact, 1), 1.0, 0.05) << scale;
  }
}

// Mean light of the cache's picture divided by the mean with whole paths.
double cached_over_path(const Scene& scene, const StereoCamera& camera, RenderOptions options) {
  const Picture fast = render_cpu(scene, camera, options);
  for (const float value : fast.eyes[0].radiance.pixels) EXPECT_TRUE(std::isfinite(value));
  options.indirect = Indirect::kPath;
  return mean_over_eyes(fast, 1) / mean_over_eyes(render_cpu(scene, camera, options), 1);
}

// Solid glass lets light pass unbent, as drafts have it: else no shadow ray would reach the lamp.
TEST(CachedLight, ALampInsideGlassInsideAClosedBox) {
  Scene scene;
  add_box(scene, vec3(-2, -1, -2), vec3(2, 1.5f, 2), add_material(scene, painted(vec3(0.7f))));
  Material glass = painted(vec3(1.0f));
  glass.roughness = 0.0f;
  glass.ior = 1.5f;
  glass.transmission = 1.0f;
  glass.thickness = 1.0f;
  add_sphere(scene, vec3(0, 0.5f, -1), 0.3f, add_material(scene, glass), 8);
  add_sphere(scene, vec3(0, 0.5f, -1), 0.1f, add_material(scene, painted(vec3(0.0f), vec3(30.0f))), 6);
  RenderOptions options = cached(32, 64);
  options.caustics = Caustics::kStraight;
  EXPECT_NEAR(cached_over_path(scene, StereoCamera{}, options), 1.0, 0.02);
}

// A room of 6 m, open towards a landscape of 2 km, from inside and from 300 m away: cells of centimetres and of metres.
TEST(CachedLight, ARoomInALandscape) {
  Scene scene = room();
  scene.instances.erase(scene.instances.begin());  // a wall
  const int grass = add_material(scene, painted(vec3(0.2f, 0.4f, 0.1f)));
  add_rectangle(scene, vec3(-1000, -1.3f, 1000), vec3(2000, 0, 0), vec3(0, 0, -2000), grass);
  scene.environment.radiance = vec3(0.5f);
  EXPECT_NEAR(cached_over_path(scene, StereoCamera{}, cached(32, 96)), 1.0, 0.02);
  StereoCamera far;
  far.position = vec3(0, 40, 300);
  EXPECT_NEAR(cached_over_path(scene, far, cached(32, 64)), 1.0, 0.02);
}

// From a bright room through a doorway into a dark one: each frame has the light of its place, also within the wall.
TEST(CachedLight, ACameraThatFliesFromRoomToRoom) {
  Scene scene;
  const int white = add_material(scene, painted(vec3(0.7f)));
  add_box(scene, vec3(-6, -1.2f, -2), vec3(6, 1.4f, 2), white);
  add_rectangle(scene, vec3(0, -1.2f, -2), vec3(0, 2.6f, 0), vec3(0, 0, 1.5f), white);
  add_rectangle(scene, vec3(0, -1.2f, 0.5f), vec3(0, 2.6f, 0), vec3(0, 0, 1.5f), white);
  add_rectangle(scene, vec3(-3, 1.3f, -0.5f), vec3(1, 0, 0), vec3(0, 0, 1),
                add_material(scene, painted(vec3(0.0f), vec3(5.0f))));
  for (const float x : {-3.0f, -0.2f, 0.0f, 0.2f, 3.0f}) {
    StereoCamera camera;
    camera.position = vec3(x, 0, 0);
    EXPECT_NEAR(cached_over_path(scene, camera, cached(32, 32)), 1.0, 0.02) << x;
  }
}

// A room whose open side is behind six panes: the closed form of what they let through is in clear_glass_test.cpp.
TEST(CachedLight, ASunBehindSixPanes) {
  Scene scene = room();
  scene.instances.erase(scene.instances.begin());  // a wall
  Material glass = painted(vec3(1.0f));
  glass.roughness = 0.0f;
  glass.ior = 1.5f;
  glass.transmission = 1.0f;
  const int pane = add_material(scene, glass);
  for (int i = 0; i < 6; i++) {
    const float z = 3.1f + 0.05f * static_cast<float>(i);
    add_rectangle(scene, vec3(-4, -2, z), vec3(8, 0, 0), vec3(0, 4, 0), pane);
  }
  scene.lights.push_back(make_sun(0.0f, 30.0f, vec3(4.0f)));
  EXPECT_NEAR(cached_over_path(scene, StereoCamera{}, cached(32, 96)), 1.0, 0.02);
}

int count_cells(const LightCells& cells) {
  const auto filled = [](const CacheCell& cell) { return cell.check != 0; };
  return static_cast<int>(std::count_if(cells.table.begin(), cells.table.end(), filled));
}

// Cells grow with the distance: a landscape of 2 km needs about as many as a room of 6 m, and a table of no more than
// four slots for each.
TEST(CachedLight, CellsAreFewHoweverLargeTheScene) {
  Scene scene = room();
  scene.instances.erase(scene.instances.begin());
  const int grass = add_material(scene, painted(vec3(0.2f, 0.4f, 0.1f)));
  for (int i = 0; i < 400; i++) {
    const vec3 corner(-1000 + 100 * static_cast<float>(i % 20), -1.3f, -1000 + 100 * static_cast<float>(i / 20));
    add_box(scene, corner, corner + vec3(30, 20, 30), grass);
  }
  add_rectangle(scene, vec3(-1000, -1.3f, 1000), vec3(2000, 0, 0), vec3(0, 0, -2000), grass);
  scene.environment.radiance = vec3(0.5f);
  const CpuRenderer renderer(scene);
  RenderOptions options = with_height(cached(32, 16), StereoCamera{});
  options.cache_paths = 1 << 20;
  for (const vec3 position : {vec3(0.0f), vec3(0, 40, 300), vec3(900, 300, 900)}) {
    StereoCamera camera;
    camera.position = position;
    const LightCells cells = renderer.fill_cells({&camera, 1}, options);
    const int count = count_cells(cells);
    EXPECT_GT(count, 100);
    EXPECT_LT(count, 120'000);
    EXPECT_LE(cells.table.size(), 4 * static_cast<size_t>(count));
  }
}

// One cache serves all pictures from one place, whatever their projection: the studio's.
TEST(CachedLight, ACacheServesSeveralPictures) {
  const Scene scene = room();
  const CpuRenderer renderer(scene);
  StereoCamera camera;
  RenderOptions options = with_height(cached(64, 16), camera);
  const LightCells cells = renderer.fill_cells({&camera, 1}, options);
  const auto sampled = [&](const LightCells* given) {
    PictureSamples samples = no_samples(options);
    renderer.sample({&camera, 1}, options, samples, {}, {}, given);
    return develop(std::move(samples), options);
  };
  EXPECT_EQ(digest(sampled(&cells)), digest(sampled(nullptr)));
  camera.projection.longitude = vec2(20, 90);
  camera.projection.latitude = vec2(-40, 30);
  options = with_height(cached(64, 64), camera);
  options.indirect = Indirect::kPath;
  const Picture with = sampled(&cells), without = sampled(nullptr);
  EXPECT_NE(digest(with), digest(without));
  EXPECT_NEAR(mean_over_eyes(with, 1) / mean_over_eyes(without, 1), 1.0, 0.02);
}

TEST(CachedLight, SameBitsForAnyThreads) {
  const Scene scene = room();
  RenderOptions options = cached(32, 16);
  options.cache_paths = 1 << 14;
  options.eyes = Eyes::kBothEyes;
  options.threads = 1;
  const uint64_t alone = digest(render_cpu(scene, StereoCamera{}, options));
  for (const int threads : {2, 5}) {
    options.threads = threads;
    EXPECT_EQ(digest(render_cpu(scene, StereoCamera{}, options)), alone) << threads;
  }
}

}  // namespace
}  // namespace ods
