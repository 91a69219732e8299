// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/light/bake.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/render/cpu/render.h"
#include "ods/render/render_target.h"
#include "tests/support/pictures.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/texels.h"

namespace ods::bake_test {

constexpr int kWidth = 48, kHeight = 40;

// A white floor and a black wall behind it, under a lamp and a white sky.
Scene corner() {
  Scene scene;
  add_rectangle(scene, vec3(-2, 0, 0), vec3(4, 0, 0), vec3(0, 0, -3), add_material(scene, matte(vec3(0.8f))));
  add_rectangle(scene, vec3(-2, 0, -3), vec3(4, 0, 0), vec3(0, 3, 0), add_material(scene, matte(vec3(0.0f))));
  add_sphere(scene, vec3(0.5f, 1.2f, -1.5f), 0.4f, add_material(scene, glow(vec3(3.0f, 2.0f, 1.0f))), 8);
  scene.environment.radiance = vec3(0.5f);
  return scene;
}

// Charts of the wall (owner 1) and the floor (owner 0), side by side; the last two columns are empty.
std::shared_ptr<const TexelRays> charts() {
  const int half = kWidth / 2;
  const TexelRays floor = texels_on(vec3(-1, 0, -2.5f), vec3(2, 0, 0), vec3(0, 0, 2), half, kHeight);
  const TexelRays wall = texels_on(vec3(-1, 2.5f, -3), vec3(2, 0, 0), vec3(0, -2, 0), half, kHeight);
  TexelRays both = empty_texels(kWidth, kHeight);
  for (int y = 0; y < kHeight; y++) {
    for (int x = 0; x < kWidth - 2; x++) {
      const auto from = static_cast<size_t>(y * half + x % half), to = static_cast<size_t>(y * kWidth + x);
      both.rays[to] = x < half ? floor.rays[from] : wall.rays[from];
      both.owners[to] = x < half ? 0 : 1;
    }
  }
  return std::make_shared<const TexelRays>(std::move(both));
}

BakeOptions with_samples(int samples) {
  BakeOptions options;
  options.render.samples = samples;
  options.viewer = vec3(0, 1.6f, -0.5f);
  return options;
}

double error_of(const Image& image, const Image& truth) {
  double squares = 0.0;
  for (size_t i = 0; i < image.pixels.size(); i++) {
    squares += std::pow(double{image.pixels[i]} - double{truth.pixels[i]}, 2.0);
  }
  return std::sqrt(squares / static_cast<double>(image.pixels.size()));
}

TEST(Bake, DenoisesWithoutMixingOwners) {
  const Scene scene = corner();
  const CpuRenderer renderer(scene);
  BakeOptions options = with_samples(8);
  const Image denoised = bake(renderer, charts(), options);
  options.is_denoised = false;
  const Image noisy = bake(renderer, charts(), options);
  options.render.samples = 512;
  options.render.seed = 1;
  const Image truth = bake(renderer, charts(), options);
  EXPECT_LT(error_of(denoised, truth), 0.5 * error_of(noisy, truth));
  double floor = 0.0;
  for (int y = 0; y < kHeight; y++) {
    for (int x = 0; x < kWidth; x++) {
      if (x < kWidth / 2) {
        floor += double{denoised.at(x, y)[0]};
      } else {
        ASSERT_EQ(denoised.at(x, y)[0], 0.0f) << x << " " << y;  // the wall is black, and the rest empty
      }
    }
  }
  EXPECT_GT(floor, 10.0);
}

// Is cancelled after every slice of the first pass, and resumes from the file.
Image bake_in_pieces(const Renderer& renderer, const BakeOptions& options, int& pieces) {
  for (pieces = 1;; pieces++) {
    int polls = 0;
    Progress progress;
    progress.cancelled = [&] { return ++polls == 2; };
    try {
      return bake(renderer, charts(), options, pieces < 4 ? progress : Progress());
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kCancelled);
      EXPECT_TRUE(std::filesystem::exists(options.unfinished));
    }
  }
}

TEST(Bake, ResumesWithTheSameBits) {
  const Scene scene = corner();
  const CpuRenderer renderer(scene);
  const TemporaryFolder folder;
  for (const float noise : {0.0f, 0.02f}) {
    BakeOptions options = with_samples(64);
    options.render.noise = noise;
    const Image whole = bake(renderer, charts(), options);
    options.unfinished = folder.path("texture.unfinished");
    int pieces = 0;
    EXPECT_EQ(bake_in_pieces(renderer, options, pieces).pixels, whole.pixels) << noise;
    EXPECT_GT(pieces, 2) << noise;
    EXPECT_FALSE(std::filesystem::exists(options.unfinished));
  }
}

// Leaves a file, and expects that bake() refuses it with these arguments.
void expect_refused(const Renderer& renderer, const std::shared_ptr<const TexelRays>& rays, const BakeOptions& options,
                    const std::string& why) {
  int pieces = 0;
  BakeOptions first = with_samples(64);
  first.unfinished = options.unfinished;
  std::filesystem::remove(options.unfinished);
  Progress progress;
  progress.cancelled = [&] { return ++pieces == 2; };
  EXPECT_THROW(bake(renderer, charts(), first, progress), Error);
  try {
    bake(renderer, rays, options);
    ADD_FAILURE() << why;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
  EXPECT_TRUE(std::filesystem::exists(options.unfinished));
}

TEST(Bake, DoesNotResumeAnotherTexture) {
  const Scene scene = corner();
  const CpuRenderer renderer(scene);
  const TemporaryFolder folder;
  BakeOptions options = with_samples(64);
  options.unfinished = folder.path("texture.unfinished");
  TexelRays moved = *charts();
  moved.rays[100].origin.x += 1e-3f;
  expect_refused(renderer, std::make_shared<const TexelRays>(moved), options, "rays");
  BakeOptions other = options;
  other.render.bounces = 3;
  expect_refused(renderer, charts(), other, "bounces");
  other = options;
  other.viewer.x = 1.0f;
  expect_refused(renderer, charts(), other, "viewer");
  other = options;
  other.scene = {{"scene", "other", ""}};
  expect_refused(renderer, charts(), other, "other options");
}

TEST(Bake, SharesALightCacheBetweenTextures) {
  const Scene scene = corner();
  const CpuRenderer renderer(scene);
  BakeOptions options = with_samples(64);
  const Image paths = bake(renderer, charts(), options);
  options.render.indirect = Indirect::kCache;
  options.render.cache_paths = 1 << 15;
  StereoCamera panorama;
  panorama.position = options.viewer;
  RenderOptions wide = options.render;
  wide.width = 128, wide.height = 64;
  const LightCells cells = renderer.fill_cells({&panorama, 1}, wide);
  EXPECT_FALSE(cells.table.empty());
  options.cells = &cells;
  const Mean cached = mean_of(bake(renderer, charts(), options));
  EXPECT_NEAR(cached.value(), mean_of(paths).value(), 0.03 * mean_of(paths).value());
}

TEST(Bake, OneSampleIsNotDenoised) {
  const Scene scene = corner();
  const CpuRenderer renderer(scene);
  BakeOptions options = with_samples(1);
  const Image once = bake(renderer, charts(), options);
  options.is_denoised = false;
  EXPECT_EQ(once.pixels, bake(renderer, charts(), options).pixels);
}

TEST(Bake, ReportsProgressToTheEnd) {
  const Scene scene = corner();
  double last = 0.0;
  Progress progress;
  progress.report = [&](double done) {
    EXPECT_GE(done, last);
    last = done;
  };
  bake(CpuRenderer(scene), charts(), with_samples(16), progress);
  EXPECT_EQ(last, 1.0);
}

// 136 bytes of samples and layers, and the table's 52.
TEST(Bake, PlansItsMemory) {
  EXPECT_EQ(bake_bytes(1000, 500, with_samples(16)), size_t{500'000} * (136 + 52));
}

}  // namespace ods::bake_test
