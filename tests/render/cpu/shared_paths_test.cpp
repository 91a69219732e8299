// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Both eyes from one path: the same picture as from independent paths, with less noise.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <span>

#include "ods/render/cpu/render.h"
#include "tests/support/layered_scene.h"
#include "tests/support/pictures.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace ods {
namespace {

// A lit room with what is hard to share: gloss, metal, a mirror, a thin pane, a veil, backs that are culled, near
// things that hide others from one eye only.
Scene hard_scene() {
  Scene scene;
  add_box(scene, vec3(-1.5f, -1.0f, -2.0f), vec3(1.5f, 1.2f, 2.0f), add_material(scene, matte(vec3(0.7f, 0.5f, 0.3f))));
  Material lamp = matte(vec3(0.0f));
  lamp.emission = vec3(4.0f, 3.0f, 2.0f);
  add_sphere(scene, vec3(0.6f, 0.8f, -0.8f), 0.2f, add_material(scene, lamp), 16);
  Material gloss = matte(vec3(0.5f, 0.2f, 0.6f));
  gloss.roughness = 0.25f;
  add_sphere(scene, vec3(-0.2f, 0.0f, -0.7f), 0.3f, add_material(scene, gloss), 24);
  Material metal = matte(vec3(0.9f, 0.7f, 0.4f));
  metal.metallic = 1.0f;
  metal.roughness = 0.4f;
  add_sphere(scene, vec3(0.5f, -0.3f, -0.5f), 0.15f, add_material(scene, metal), 24);
  Material mirror = metal;
  mirror.roughness = 0.0f;
  add_sphere(scene, vec3(0.0f, -0.1f, 0.8f), 0.3f, add_material(scene, mirror), 24);
  Material pane = matte(vec3(0.8f));
  pane.transmission = 0.7f;
  pane.roughness = 0.5f;
  pane.double_sided = 1;
  add_rectangle(scene, vec3(-1.0f, -0.5f, 0.4f), vec3(0.4f, 0.0f, 0.3f), vec3(0.0f, 0.8f, 0.0f),
                add_material(scene, pane));
  Material veil = matte(vec3(0.2f, 0.6f, 0.3f));
  veil.alpha_mode = kAlphaBlend;
  veil.base_color.w = 0.4f;
  veil.double_sided = 1;
  add_rectangle(scene, vec3(0.7f, -0.6f, -0.2f), vec3(0.0f, 0.0f, 0.7f), vec3(0.0f, 0.9f, 0.0f),
                add_material(scene, veil));
  Material culled = matte(vec3(0.3f));
  culled.double_sided = 0;
  add_rectangle(scene, vec3(-0.9f, 0.3f, -0.6f), vec3(0.0f, 0.0f, 0.5f), vec3(0.0f, 0.3f, 0.0f),
                add_material(scene, culled));
  return scene;
}

struct View {
  const char* name;
  PixelFilter filter;
  std::function<void(StereoCamera&)> change;
};

StereoCamera camera_of(const View& view) {
  StereoCamera camera;
  camera.position = vec3(0.05f, 0.1f, 0.0f);
  camera.ipd = 0.12f;
  if (view.change) view.change(camera);
  return camera;
}

void look_through(StereoCamera& camera, const char* projection) {
  camera.projection = find_projection(projection)->setting;
}

const std::vector<View>& views() {
  static const std::vector<View> views = {
      {"box filter", PixelFilter::kBox, {}},
      {"wide filter", PixelFilter::kBlackmanHarris, {}},
      {"merge, toe-in", PixelFilter::kBox,
       [](StereoCamera& c) {
         c.top = c.bottom = {kMergeSmoothstep, 40.0f, 80.0f, 1.0f};
         c.convergence = kShift;
       }},
      {"toe-in", PixelFilter::kBox, [](StereoCamera& c) { c.convergence = kToeIn; }},
      {"cosine merge, tilted", PixelFilter::kBox,
       [](StereoCamera& c) {
         c.top = c.bottom = {kMergeCosine, 0.0f, 90.0f, 1.0f};
         c.pitch = 20.0f;
         c.roll = 10.0f;
       }},
      {"cube", PixelFilter::kBlackmanHarris, [](StereoCamera& c) { look_through(c, "cube-3x2"); }},
      {"eac", PixelFilter::kBox, [](StereoCamera& c) { look_through(c, "eac"); }},
      {"fisheye", PixelFilter::kBlackmanHarris, [](StereoCamera& c) { look_through(c, "fisheye"); }},
      {"perspective", PixelFilter::kBox, [](StereoCamera& c) { look_through(c, "perspective"); }},
      {"cylinder", PixelFilter::kBox, [](StereoCamera& c) { look_through(c, "cylinder"); }},
  };
  return views;
}

RenderOptions options_with(bool share, const View& view, int samples) {
  RenderOptions options = small_render(48, samples);
  options.eyes = Eyes::kBothEyes;
  options.share_paths = share;
  options.filter = view.filter;
  options.bounces = 3;
  return options;
}

// Sums of blocks of 6x6 pixels in both eyes, the three channels apart.
std::vector<double> block_sums(const Picture& picture) {
  std::vector<double> sums;
  for (const EyeImage& eye : picture.eyes) {
    const Image& image = eye.radiance;
    const size_t columns = static_cast<size_t>((image.width + 5) / 6),
                 rows = static_cast<size_t>((image.height + 5) / 6);
    const size_t begin = sums.size();
    sums.resize(begin + 3 * columns * rows);
    for (int y = 0; y < image.height; y++) {
      for (int x = 0; x < image.width; x++) {
        const size_t block = static_cast<size_t>(y / 6) * columns + static_cast<size_t>(x / 6);
        for (size_t c = 0; c < 3; c++) sums[begin + 3 * block + c] += double{image.at(x, y)[c]};
      }
    }
  }
  return sums;
}

void expect_same_light(const Scene& scene, std::span<const View> views) {
  const CpuRenderer renderer(scene);
  constexpr int kSeeds = 16;
  for (const View& view : views) {
    const StereoCamera camera = camera_of(view);
    std::vector<Mean> difference;
    for (int seed = 0; seed < kSeeds; seed++) {
      RenderOptions together = options_with(true, view, 2), apart = options_with(false, view, 2);
      together.seed = static_cast<uint32_t>(seed);
      apart.seed = static_cast<uint32_t>(seed + 1000);
      const std::vector<double> a = block_sums(renderer.render(camera, together));
      const std::vector<double> b = block_sums(renderer.render(camera, apart));
      difference.resize(a.size());
      for (size_t i = 0; i < a.size(); i++) difference[i].add(a[i] - b[i]);
    }
    double chi_square = 0.0, blocks = 0.0, sum = 0.0, sum_variance = 0.0;
    for (const Mean& mean : difference) {
      if (mean.variance() <= 0.0) continue;
      const double z = mean.value() / std::sqrt(mean.variance());
      EXPECT_LT(std::abs(z), 8.0) << view.name;
      chi_square += z * z, blocks += 1.0;
      sum += mean.value(), sum_variance += mean.variance();
    }
    // z is Student's t of 15 degrees of freedom: its square has the mean 15/13 and a variance of 3.4. Channels vary
    // together.
    EXPECT_LT(chi_square, blocks * 15.0 / 13.0 + 5.0 * std::sqrt(3.0 * 3.4 * blocks)) << view.name;
    EXPECT_LT(std::abs(sum), 4.5 * std::sqrt(3.0 * sum_variance)) << view.name;
    EXPECT_GT(blocks, 100.0) << view.name;
  }
}

TEST(SharedPaths, BringTheSameLight) {
  expect_same_light(hard_scene(), views());
}

TEST(SharedPaths, BringTheSameLightToLayers) {
  expect_same_light(layered_scene(), std::span(views()).first(2));
}

TEST(SharedPaths, KeepAFurnaceWhite) {
  Scene scene;
  Material wall = matte(vec3(1.0f));
  wall.emission = vec3(0.7f);
  add_box(scene, vec3(-1.0f, -2.0f, -1.5f), vec3(2.0f, 1.0f, 1.0f), add_material(scene, wall));
  for (const LightSampling sampling : {LightSampling::kBoth, LightSampling::kLightsOnly, LightSampling::kBsdfOnly}) {
    RenderOptions options = options_with(true, views()[0], 64);
    options.light_sampling = sampling;
    for (const EyeImage& eye : render_cpu(scene, StereoCamera{}, options).eyes) {
      const Mean mean = mean_of(eye.radiance);
      EXPECT_NEAR(mean.value(), 4 * 0.7, 5.0 * std::sqrt(mean.variance()) + 1e-4);
      EXPECT_NEAR(mean.value(), 4 * 0.7, 0.03);
    }
  }
}

TEST(SharedPaths, GiveTheSameBitsWhateverTheThreads) {
  const Scene scene = hard_scene();
  RenderOptions options = options_with(true, views()[1], 8);
  options.statistics = true;
  options.threads = 1;
  const uint64_t one = digest(render_cpu(scene, StereoCamera{}, options));
  options.threads = 3;
  EXPECT_EQ(one, digest(render_cpu(scene, StereoCamera{}, options)));
  options.last_tile_first = true;
  EXPECT_EQ(one, digest(render_cpu(scene, StereoCamera{}, options)));
}

// The variance of pixels of a matt room over many seeds: less than without sharing, and equal to the statistics.
TEST(SharedPaths, HaveLessNoise) {
  Scene scene;
  add_box(scene, vec3(-1.5f, -1.0f, -2.0f), vec3(1.5f, 1.2f, 2.0f), add_material(scene, matte(vec3(0.7f))));
  Material lamp = matte(vec3(0.0f));
  lamp.emission = vec3(4.0f);
  add_sphere(scene, vec3(0.6f, 0.8f, -0.8f), 0.2f, add_material(scene, lamp), 16);
  const CpuRenderer renderer(scene);
  double variance[2] = {}, said[2] = {};
  for (const bool share : {false, true}) {
    std::vector<Mean> pixels(48 * 24);
    for (uint32_t seed = 0; seed < 24; seed++) {
      RenderOptions options = options_with(share, views()[0], 8);
      options.statistics = true;
      options.seed = seed;
      const EyeImage eye = renderer.render(StereoCamera{}, options).eyes[0];
      for (size_t i = 0; i < pixels.size(); i++) {
        pixels[i].add(double{eye.radiance.pixels[3 * i]});
        said[share] += double{eye.variance.pixels[3 * i]} / 24.0;
      }
    }
    for (const Mean& pixel : pixels) variance[share] += 24.0 * pixel.variance();
  }
  EXPECT_LT(variance[1], 0.95 * variance[0]);

  // 0.66 and 0.87: where lights are picked by distance, strata take much of what is left, and more without sharing.
  EXPECT_NEAR(said[1] / said[0], variance[1] / variance[0], 0.25);
  // Stratified samples vary less than independent ones, which the statistics assume.
  EXPECT_LT(variance[1], 1.2 * said[1]);
  EXPECT_GT(variance[1], 0.4 * said[1]);
}

}  // namespace
}  // namespace ods
