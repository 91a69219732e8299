// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/sampling_plan.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "ods/kernel/camera/camera.h"

namespace ods {

// Minimum share of blocks near the poles: a flat view of the picture shows them enlarged.
static constexpr float kSmallestShare = 0.35f;

static int blocks_along(int pixels) {
  return (pixels + kBlockSize - 1) / kBlockSize;
}

int block_columns(const RenderOptions& options) {
  return blocks_along(options.width);
}

size_t block_count(const RenderOptions& options) {
  return static_cast<size_t>(block_columns(options)) * static_cast<size_t>(blocks_along(options.height));
}

static float block_angle(const Projection& projection, const RenderOptions& options, int column, int row) {
  const vec2 size(static_cast<float>(options.width), static_cast<float>(options.height));
  const vec2 begin(static_cast<float>(column * kBlockSize), static_cast<float>(row * kBlockSize));
  const vec2 middle = (begin + min(begin + vec2(static_cast<float>(kBlockSize)), size)) * 0.5f / size;
  return relative_solid_angle(projection, middle, middle);
}

SamplingPlan make_plan(const StereoCamera& camera, const RenderOptions& options) {
  SamplingPlan plan;
  plan.columns = block_columns(options);
  plan.share.assign(block_count(options), 1.0f);
  plan.texels = camera.texel_rays;
  if (!options.even_noise || plan.texels) return plan;
  const Projection projection = make_camera(camera).projection;
  for (size_t i = 0; i < plan.share.size(); i++) {
    const int block = static_cast<int>(i);
    plan.share[i] = block_angle(projection, options, block % plan.columns, block / plan.columns);
  }
  const float largest = *std::max_element(plan.share.begin(), plan.share.end());
  for (float& share : plan.share) share = std::max(share / largest, kSmallestShare);
  return plan;
}

size_t block_at(const SamplingPlan& plan, int x, int y) {
  return static_cast<size_t>(y / kBlockSize * plan.columns + x / kBlockSize);
}

int samples_of(const SamplingPlan& plan, size_t block, int samples) {
  return static_cast<int>(std::ceil(static_cast<double>(samples) * double{plan.share[block]}));
}

// Cycles' measure: the differences between all samples and half of them have the size of the mean's standard deviation.
// Dark pixels are judged by the square root of their light, like the eye does.
static double pixel_noise(const EyeSamples& eye, size_t pixel, double gain) {
  const vec3 variance = variance_of_mean(eye, pixel);
  const double deviation =
      std::sqrt(double{variance.x}) + std::sqrt(double{variance.y}) + std::sqrt(double{variance.z});
  const double count = std::max(eye.count[pixel], 1u);
  double light = 0.0;
  for (size_t c = 0; c < 3; c++) light += static_cast<double>(eye.light[3 * pixel + c]) / (kLightUnit * count);
  light *= gain;
  return deviation * gain / (1e-4 + (light < 1.0 ? std::sqrt(std::max(light, 0.0)) : light));
}

static bool is_empty(const SamplingPlan& plan, size_t pixel) {
  return plan.texels && plan.texels->rays[pixel].direction == vec3(0.0f);
}

// The mean square of the noise of one class of a block's pixels, in both eyes, as if all pixels had the same size on
// the sphere, and `now` samples. Negative if no pixel of the class is in the picture.
static double class_noise(const PictureSamples& samples, const SamplingPlan& plan, double gain, size_t block,
                          int wanted, double now) {
  const int x0 = static_cast<int>(block) % plan.columns * kBlockSize;
  const int y0 = static_cast<int>(block) / plan.columns * kBlockSize;
  double sum = 0.0;
  int pixels = 0;
  for (const EyeSamples& eye : samples.eyes) {
    for (int y = y0; y < std::min(y0 + kBlockSize, samples.height); y++) {
      for (int x = x0; x < std::min(x0 + kBlockSize, samples.width); x++) {
        if (class_of(x, y) != wanted) continue;
        const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(samples.width) + static_cast<size_t>(x);
        if (is_empty(plan, pixel)) continue;
        const double noise = pixel_noise(eye, pixel, gain);
        sum += noise * noise * eye.count[pixel] / now;
        pixels++;
      }
    }
  }
  return pixels > 0 ? sum / pixels * static_cast<double>(plan.share[block]) : -1.0;
}

// The noise by which one class of a block is judged: that of the other class. The noise of a class that has stopped is
// scaled as if it had continued; otherwise it would stay, and the other class would be sampled forever.
static double noise_beside(const PictureSamples& samples, const SamplingPlan& plan, double gain, size_t block,
                           int judged) {
  const int x0 = static_cast<int>(block) % plan.columns * kBlockSize;
  const int y0 = static_cast<int>(block) / plan.columns * kBlockSize;
  const size_t first = static_cast<size_t>(y0) * static_cast<size_t>(samples.width) + static_cast<size_t>(x0);
  size_t own = first;  // a pixel of the judged class: a block begins with class 0; one of a single pixel has no other
  if (judged == 1 && x0 + 1 < samples.width) {
    own = first + 1;
  } else if (judged == 1 && y0 + 1 < samples.height) {
    own = first + static_cast<size_t>(samples.width);
  }
  const double now = samples.eyes[0].count[own];
  double noise = class_noise(samples, plan, gain, block, 1 - judged, now);
  // A texture may have so few texels there that all are in one class.
  if (noise < 0.0 && plan.texels) noise = class_noise(samples, plan, gain, block, judged, now);
  return std::max(noise, 0.0);
}

double judge_noise(const SamplingPlan& plan, const RenderOptions& options, PictureSamples& samples) {
  const double clean = std::pow(5.0 * static_cast<double>(options.noise), 2.0);  // 5: Cycles' scale of its threshold
  const double gain = std::exp2(double{options.noise_exposure});
  if (samples.judged_at != options.noise_exposure) std::ranges::fill(samples.noisy, kBothClasses);
  samples.judged_at = options.noise_exposure;
  std::vector<double> excess(plan.share.size());
  tbb::parallel_for(size_t{0}, samples.noisy.size(), [&](size_t block) {
    for (int one : {0, 1}) {
      if (!(samples.noisy[block] >> one & 1)) continue;
      const double noise = noise_beside(samples, plan, gain, block, one) / clean;
      if (noise <= 1.0) samples.noisy[block] = static_cast<uint8_t>(samples.noisy[block] & ~(1 << one));
      excess[block] += 0.5 * std::max(noise - 1.0, 0.0);
    }
  });
  double more = 0.0, shares = 0.0;
  const double at_most = static_cast<double>(options.samples - samples.done) / std::max(samples.done, 1);
  for (size_t i = 0; i < excess.size(); i++) {
    more += double{plan.share[i]} * std::min(excess[i], at_most);
    shares += double{plan.share[i]};
  }
  return more / shares;
}

}  // namespace ods
