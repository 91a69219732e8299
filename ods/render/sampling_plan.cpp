// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/sampling_plan.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "ods/kernel/camera/camera.h"

namespace ods {

// Blocks near the poles still get this share: a flat view of the picture shows them large.
static constexpr float kSmallestShare = 0.125f;

static size_t block_count(const SamplingPlan& plan) {
  return static_cast<size_t>(plan.columns) * static_cast<size_t>(plan.rows);
}

// The area of a spherical triangle of unit vectors. Source: Van Oosterom and Strackee, 1983.
static double triangle_area(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  const double volume = dot(a, cross(b, c));
  return 2.0 * std::atan2(std::abs(volume), 1.0 + dot(a, b) + dot(b, c) + dot(c, a));
}

// What the pixel at this position covers of the sphere; 0 where the picture is empty.
static double solid_angle(const Projection& projection, vec2 center, vec2 pixel) {
  glm::dvec3 corners[4];
  for (int i = 0; i < 4; i++) {
    const vec2 corner = center + pixel * vec2(i == 0 || i == 3 ? -0.5f : 0.5f, i < 2 ? -0.5f : 0.5f);
    const ViewDirection look = look_of(projection, center, corner);
    if (!look.seen) return 0.0;
    corners[i] = look.direction;
  }
  return triangle_area(corners[0], corners[1], corners[2]) + triangle_area(corners[0], corners[2], corners[3]);
}

// Of the pixel in the block's middle, measured over the block, where single precision is fine enough.
static double block_angle(const Projection& projection, const RenderOptions& options, int column, int row) {
  const vec2 size(static_cast<float>(options.width), static_cast<float>(options.height));
  const vec2 begin(static_cast<float>(column * kBlockSize), static_cast<float>(row * kBlockSize));
  const vec2 end = min(begin + vec2(static_cast<float>(kBlockSize)), size);
  const vec2 span = end - begin;
  const double angle = solid_angle(projection, (begin + end) * 0.5f / size, span / size);
  return angle / static_cast<double>(span.x * span.y);
}

SamplingPlan make_plan(const StereoCamera& camera, const RenderOptions& options) {
  SamplingPlan plan;
  plan.columns = (options.width + kBlockSize - 1) / kBlockSize;
  plan.rows = (options.height + kBlockSize - 1) / kBlockSize;
  plan.share.assign(block_count(plan), 1.0f);
  plan.noisy.assign(block_count(plan), 3);
  if (!options.even_noise) return plan;
  const Projection projection = make_camera(camera).projection;
  std::vector<double> angles(block_count(plan));
  tbb::parallel_for(0, plan.rows, [&](int row) {
    for (int column = 0; column < plan.columns; column++) {
      angles[static_cast<size_t>(row * plan.columns + column)] = block_angle(projection, options, column, row);
    }
  });
  const double largest = *std::max_element(angles.begin(), angles.end());
  for (size_t i = 0; i < angles.size(); i++) {
    // 0: at the rim of an image circle, where part of the block is empty.
    if (angles[i] > 0.0) plan.share[i] = std::max(static_cast<float>(angles[i] / largest), kSmallestShare);
  }
  return plan;
}

int samples_of(const SamplingPlan& plan, size_t block, int samples) {
  return static_cast<int>(std::ceil(static_cast<double>(samples) * double{plan.share[block]}));
}

// Cycles' measure: the differences between all samples and half of them have the size of the mean's standard deviation.
// Dark pixels are judged by the square root of their light, as eyes do.
static double pixel_noise(const EyeSamples& eye, size_t pixel) {
  const vec3 variance = variance_of_mean(eye, pixel);
  const double deviation =
      std::sqrt(double{variance.x}) + std::sqrt(double{variance.y}) + std::sqrt(double{variance.z});
  const double count = std::max(eye.count[pixel], 1u);
  double light = 0.0;
  for (size_t c = 0; c < 3; c++) light += static_cast<double>(eye.light[3 * pixel + c]) / (kLightUnit * count);
  return deviation / (1e-4 + (light < 1.0 ? std::sqrt(std::max(light, 0.0)) : light));
}

// The mean square of the noise of one class of a block's pixels, in both eyes, as if all pixels had the same size on
// the sphere.
static double block_noise(const PictureSamples& samples, const SamplingPlan& plan, size_t block, int wanted) {
  const int x0 = static_cast<int>(block) % plan.columns * kBlockSize;
  const int y0 = static_cast<int>(block) / plan.columns * kBlockSize;
  double sum = 0.0;
  int pixels = 0;
  for (const EyeSamples& eye : samples.eyes) {
    for (int y = y0; y < std::min(y0 + kBlockSize, samples.height); y++) {
      for (int x = x0; x < std::min(x0 + kBlockSize, samples.width); x++) {
        if (class_of(x, y) != wanted) continue;
        const double noise =
            pixel_noise(eye, static_cast<size_t>(y) * static_cast<size_t>(samples.width) + static_cast<size_t>(x));
        sum += noise * noise;
        pixels++;
      }
    }
  }
  return pixels > 0 ? sum / pixels * static_cast<double>(plan.share[block]) : 0.0;
}

double judge_noise(const PictureSamples& samples, const RenderOptions& options, SamplingPlan& plan) {
  const double clean = std::pow(5.0 * static_cast<double>(options.noise), 2.0);  // 5: as Cycles scales its threshold
  std::vector<double> excess(block_count(plan));
  tbb::parallel_for(size_t{0}, plan.noisy.size(), [&](size_t block) {
    for (int one : {0, 1}) {
      if (!(plan.noisy[block] >> one & 1)) continue;
      const double noise = block_noise(samples, plan, block, 1 - one) / clean;
      if (noise <= 1.0) plan.noisy[block] = static_cast<uint8_t>(plan.noisy[block] & ~(1 << one));
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
