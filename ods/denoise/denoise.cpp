// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/denoise/denoise.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <functional>
#include <mutex>

#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/denoise/detail.h"
#include "ods/denoise/edges.h"
#include "ods/denoise/filter.h"
#include "ods/denoise/outliers.h"

namespace ods {
namespace {

// The narrower a pass, the larger the fraction of noise in the light that it removes.
constexpr FilterPass kPasses[] = {{1, 2.0f}, {2, 2.0f}, {4, 1.5f}, {8, 1.5f}, {16, 1.5f}};

// Counts blocks of all passes; the thread that finishes a block reports progress.
class Steps {
 public:
  Steps(const Progress& progress, size_t total) : progress_(progress), total_(static_cast<double>(total)) {}
  bool stopped() {
    if (!stop_ && progress_.cancelled && progress_.cancelled()) stop_ = true;
    return stop_;
  }
  void done() {
    const double count = static_cast<double>(++count_);
    if (!progress_.report) return;
    if (const std::unique_lock free(reporting_, std::try_to_lock); free) {
      progress_.report(std::min(count / total_, 1.0));
    }
  }

 private:
  const Progress& progress_;
  double total_;
  std::atomic<size_t> count_ = 0;
  std::atomic<bool> stop_ = false;
  std::mutex reporting_;
};

void check_statistics(const std::vector<Level>& levels) {
  for (const Level& level : levels) {
    for (size_t i = 0; i < level.variance.size(); i++) {
      if (unpack_variance(level.variance[i]) >= 0.0f && std::isfinite(level.light[3 * i])) return;
    }
  }
  throw Error(ErrorKind::kInput,
              "cannot denoise: the variance of every pixel is NaN, infinite, negative or of fewer than 2 samples");
}

void put_back(const NoisyPicture& noisy, const std::vector<Level>& levels, Picture& picture) {
  for (size_t e = 0; e < levels.size(); e++) {
    EyeImage& eye = picture.eyes[e];
    tbb::parallel_for(0, noisy.height(), [&](int y) {
      for (int x = 0; x < noisy.width(); x++) {
        const size_t i = noisy.index(x, y);
        // Exact light, and light without similar neighbours, keeps its bits.
        if (!(unpack_variance(levels[e].variance[i]) > 0.0f)) continue;
        const vec3 by = divisor(eye, i);
        for (size_t c = 0; c < 3; c++) {
          eye.radiance.pixels[3 * i + c] = levels[e].light[3 * i + c] * by[static_cast<int>(c)];
        }
      }
    });
  }
}

bool has_depth(const Picture& picture) {
  return std::ranges::none_of(picture.eyes, [](const EyeImage& eye) { return eye.depth.pixels.empty(); });
}

std::vector<Level> first_levels(const NoisyPicture& noisy) {
  std::vector<Level> levels;
  for (int eye = 0; eye < static_cast<int>(noisy.picture->eyes.size()); eye++)
    levels.push_back(first_level(noisy, eye));
  return levels;
}

void open_frame(NoisyFrame& frame, const FrameBeside& beside) {
  open_noisy(frame.noisy, beside.picture, beside.camera);
  frame.levels = first_levels(frame.noisy);
  take_outliers(frame.noisy, frame.levels);  // their light is not part of this frame
  doubt_darkness(frame.noisy, frame.levels);
  frame.beside = &beside;
}

// Leaves the result of the last pass in `levels`, and returns it with the restored details. Variance and share are
// those of the first pass.
std::vector<Level> run_passes(const NoisyPicture& noisy, std::vector<Level>& levels, std::vector<Level>& next,
                              Steps& steps) {
  std::vector<FilterPass> passes(std::begin(kPasses), std::end(kPasses));
  expect_noise(passes);
  std::vector<Level> result;
  for (const Level& level : levels) result.push_back({std::vector<float>(level.light.size(), 0.0f), {}, {}});
  for (const FilterPass& pass : passes) {
    for_each_block(noisy, [&](Block& block) {
      if (steps.stopped()) return;
      filter_block(noisy, levels, next, pass, block);
      steps.done();
    });
    for_each_block(noisy, [&](Block& block) {
      if (steps.stopped()) return;
      add_detail(noisy, levels, next, pass, result[static_cast<size_t>(block.eye)].light, block);
      steps.done();
    });
    if (steps.stopped()) throw Error(ErrorKind::kCancelled, "denoising was stopped");
    std::swap(levels, next);
    for (size_t e = 0; e < levels.size() && pass.stride == 1; e++) {
      result[e].variance = levels[e].variance, result[e].share = levels[e].share;
    }
  }
  for (size_t e = 0; e < levels.size(); e++) {
    std::vector<float>& light = result[e].light;
    std::transform(light.begin(), light.end(), levels[e].light.begin(), light.begin(), std::plus<>());
  }
  return result;
}

void denoise_here(Picture& picture, const StereoCamera& camera, const DenoiseOptions& options,
                  const Progress& progress) {
  NoisyPicture noisy;
  open_noisy(noisy, picture, camera);
  std::vector<Level> levels = first_levels(noisy);
  check_statistics(levels);
  if (!options.keep_statistics) {
    for (EyeImage& eye : picture.eyes) eye.variance = eye.samples = Image();
  }
  const std::vector<Outlier> outliers = take_outliers(noisy, levels);
  doubt_darkness(noisy, levels);
  std::vector<Level> next = levels;
  const bool knows_surfaces = has_depth(picture);
  const bool both = options.both_eyes && picture.eyes.size() == 2 && knows_surfaces;
  std::deque<NoisyFrame> beside;
  if (knows_surfaces) {
    for (const FrameBeside& frame : options.beside) open_frame(beside.emplace_back(), frame);
  }
  Steps steps(progress, 2 * std::size(kPasses) * count_blocks(noisy));
  if (both || !beside.empty()) {
    for_each_block(noisy, [&](Block& block) {
      if (!steps.stopped()) merge_views(noisy, levels, next, both, beside, block);
    });
    std::swap(levels, next);
  }
  fit_edges(noisy, run_passes(noisy, levels, next, steps), levels);
  spread_outliers(noisy, outliers, both, levels);
  put_back(noisy, levels, picture);
  if (progress.report) progress.report(1.0);
}

}  // namespace

bool has_variance(const Picture& picture) {
  return std::ranges::any_of(picture.eyes, [](const EyeImage& eye) {
    return std::ranges::any_of(eye.samples.pixels, [](float samples) { return samples > 1.0f; });
  });
}

void denoise(Picture& picture, const StereoCamera& camera, const DenoiseOptions& options, const Progress& progress) {
  assert(!picture.eyes.empty() && picture.eyes.size() <= 2);
  assert(!picture.eyes.front().variance.pixels.empty() && !picture.eyes.back().variance.pixels.empty());
  const Image& first = picture.eyes[0].radiance;
  const size_t pixel = 45 + 15 * options.beside.size();
  check_memory(pixel * static_cast<size_t>(first.width) * static_cast<size_t>(first.height) * picture.eyes.size(),
               "denoising", "a smaller picture or a single eye needs less");
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  arena.execute([&] { denoise_here(picture, camera, options, progress); });
}

}  // namespace ods
