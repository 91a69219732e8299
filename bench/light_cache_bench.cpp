// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Error of the light cache relative to whole paths: light_cache_bench [SAMPLES [SCENE...]]. A scene is one of those
// below or a glTF file. 1024 samples of all of them take an hour of a core.
//
// mean: the picture's light relative to paths. blocks: the fraction of blocks of 8x8 pixels whose mean is within 2 % of
// the mean by paths, or within three standard deviations of both pictures' noise. worst: the error that 1 % of the
// blocks exceed. noise: the median block's standard deviation. s: CPU seconds of a picture by paths, by the cache, and
// of filling it with 2^20 paths. Two pictures each, each with its own cache; one eye, 256x128 pixels, box filter.
//
// The scene `leaks` is made for this: rooms of different light behind walls of 1 cm, a shelf of thin boards, a cupboard
// ajar, and a garden seen through an open window.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "bench/lit_scene.h"
#include "bench/measure.h"
#include "bench/subjects.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/builtin/builder.h"

namespace {

using namespace ods;

constexpr int kWidth = 256, kBlock = 8;
constexpr int kCachePaths = 1 << 20;  // the number for a draft of a useful size

void add_block(Scene& scene, vec3 low, vec3 high, int material) {
  add(scene, make_box(high - low), material, placed(0.5f * (low + high)));
}

Scene make_leaks() {
  Scene scene;
  const int white = add_material(scene, matte(vec3(0.8f)));
  const int wood = add_material(scene, matte(vec3(0.5f, 0.3f, 0.15f)));
  const int grass = add_material(scene, matte(vec3(0.15f, 0.3f, 0.08f)));
  const int lamp = add_material(scene, glow(vec3(60.0f)));
  const float t = 0.01f;
  // Two rooms of 4 m, the left one lit; a doorway of 20 cm leads from one to the other.
  add_block(scene, vec3(-4, 0, -2), vec3(4, t, 2), white);
  add_block(scene, vec3(-4, 2.5f, -2), vec3(4, 2.5f + t, 2), white);
  add_block(scene, vec3(-4 - t, 0, -2), vec3(-4, 2.5f, 2), white);
  add_block(scene, vec3(-4, 0, 2), vec3(4, 2.5f, 2 + t), white);
  add_block(scene, vec3(0, 0, -2), vec3(t, 2.5f, 1.8f), white);
  add_block(scene, vec3(-2.2f, 2.3f, -0.2f), vec3(-1.8f, 2.32f, 0.2f), lamp);
  // The garden's wall, with a window without a pane.
  add_block(scene, vec3(4, 0, -2), vec3(4 + t, 0.9f, 2), white);
  add_block(scene, vec3(4, 2, -2), vec3(4 + t, 2.5f, 2), white);
  add_block(scene, vec3(4, 0.9f, -2), vec3(4 + t, 2, -0.5f), white);
  add_block(scene, vec3(4, 0.9f, 0.5f), vec3(4 + t, 2, 2), white);
  add_block(scene, vec3(-4, 0, -2 - t), vec3(4, 2.5f, -2), white);
  // A shelf whose boards are closer than cells, and a cupboard ajar.
  for (int i = 0; i < 12; i++) {
    const float y = 0.1f + 0.08f * static_cast<float>(i);
    add_block(scene, vec3(1, y, -2), vec3(2.2f, y + 0.005f, -1.7f), wood);
  }
  add_block(scene, vec3(2.6f, 0, -2), vec3(2.6f + t, 1.8f, -1.4f), wood);
  add_block(scene, vec3(3.4f, 0, -2), vec3(3.4f + t, 1.8f, -1.4f), wood);
  add_block(scene, vec3(2.6f, 1.8f, -2), vec3(3.4f, 1.8f + t, -1.4f), wood);
  add_block(scene, vec3(2.6f, 0, -1.4f), vec3(3.35f, 1.8f, -1.4f + t), wood);
  add_block(scene, vec3(-60, -0.2f, -60), vec3(60, -0.1f, 60), grass);
  scene.lights.push_back(make_sun(120.0f, 40.0f, vec3(3.0f)));
  scene.environment = make_environment(32, [](vec3 d) { return vec3(0.3f, 0.4f, 0.6f) * (d.y > 0.0f ? 1.0f : 0.1f); });
  scene.view_points.push_back({});
  scene.view_points.back().position = vec3(1.2f, 1.3f, 0.4f);
  return scene;
}

struct Subjected {
  Scene scene;
  StereoCamera camera;
};

Subjected subject_of(const std::string& name) {
  if (name == "leaks") {
    Subjected result{make_leaks(), {}};
    result.camera.position = default_view(result.scene).position;
    return result;
  }
  if (std::filesystem::exists(name)) {
    Subjected result{lit_scene(name), {}};
    result.camera.position = default_view(result.scene).position;
    return result;
  }
  const Subject subject = name == kAtrium.name ? kAtrium : name == kHelmet.name ? kHelmet : Subject{name.c_str()};
  Subjected result{load(subject), {}};
  result.camera = camera_of(subject, result.scene);
  return result;
}

// A picture's blocks: the mean of their light, and its variance.
struct Blocks {
  std::vector<double> light, variance;
};

Blocks blocks_of(const EyeImage& eye) {
  Blocks blocks;
  for (int y = 0; y + kBlock <= eye.radiance.height; y += kBlock) {
    for (int x = 0; x + kBlock <= eye.radiance.width; x += kBlock) {
      double light = 0.0, variance = 0.0;
      for (int i = 0; i < kBlock * kBlock; i++) {
        for (int c = 0; c < 3; c++) {
          light += double{eye.radiance.at(x + i % kBlock, y + i / kBlock)[c]};
          variance += 3.0 * double{eye.variance.at(x + i % kBlock, y + i / kBlock)[c]};  // colours vary together
        }
      }
      const double count = 3.0 * kBlock * kBlock;
      blocks.light.push_back(light / count), blocks.variance.push_back(variance / (count * count));
    }
  }
  return blocks;
}

double share_of(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void judge(const std::string& name, int samples) {
  const Subjected subject = subject_of(name);
  const CpuRenderer renderer(subject.scene);
  RenderOptions options = options_of(kWidth, samples);
  options.eyes = Eyes::kMonoEye;
  options.statistics = true;
  options.cache_paths = kCachePaths;
  Blocks blocks[2];  // of paths and of the cache
  double seconds[2] = {};
  for (const Indirect indirect : {Indirect::kPath, Indirect::kCache}) {
    const bool cached = indirect == Indirect::kCache;
    for (const uint32_t seed : {1u, 2u}) {
      options.seed = seed + (cached ? 10u : 0u);
      options.indirect = indirect;
      Picture picture;
      seconds[cached] += seconds_of([&] { picture = renderer.render(subject.camera, options); }).cpu;
      const Blocks one = blocks_of(picture.eyes[0]);
      blocks[cached].light.resize(one.light.size()), blocks[cached].variance.resize(one.light.size());
      for (size_t i = 0; i < one.light.size(); i++) {
        blocks[cached].light[i] += 0.5 * one.light[i], blocks[cached].variance[i] += 0.25 * one.variance[i];
      }
    }
  }
  options.samples = 1;
  const double fill = seconds_of([&] { renderer.render(subject.camera, options); }).cpu;
  std::vector<double> errors, noises;
  double light[2] = {};
  int good = 0;
  for (size_t i = 0; i < blocks[0].light.size(); i++) {
    light[0] += blocks[0].light[i], light[1] += blocks[1].light[i];
    const double level = std::max(blocks[0].light[i], 1e-6);
    const double apart = std::abs(blocks[1].light[i] - blocks[0].light[i]);
    const double noise = std::sqrt(blocks[0].variance[i] + blocks[1].variance[i]);
    good += apart <= std::max(0.02 * level, 3.0 * noise);
    errors.push_back(apart / level), noises.push_back(noise / level);
  }
  const std::string shown = std::filesystem::path(name).stem();
  fmt::print("{:12} {:+8.2f} {:8.1f} {:8.1f} {:8.2f} {:8.1f} {:8.1f} {:8.1f}\n", shown,
             100.0 * (light[1] / light[0] - 1.0), 100.0 * good / static_cast<double>(errors.size()),
             100.0 * share_of(errors, 0.99), 100.0 * share_of(noises, 0.5), 0.5 * seconds[0], 0.5 * seconds[1] - fill,
             fill);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int samples = argc > 1 ? std::stoi(argv[1]) : 1024;
  std::vector<std::string> names(argv + std::min(argc, 2), argv + argc);
  if (names.empty()) names = {"room", "toys", "wineglass", "mirrors", "atrium", "leaks"};
  fmt::print("{:12} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "", "mean %", "blocks %", "worst %", "noise %",
             "path s", "cache s", "fill s");
  for (const std::string& name : names) judge(name, samples);
}
