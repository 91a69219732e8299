// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Compares samples of a card, or of software Vulkan, with the CPU's. They are equal in distribution, not bit by bit:
// paths part after a last bit differs. So light is judged by blocks of 8 x 8 pixels, in standard errors.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ods/render/gpu/gpu_device.h"
#include "ods/render/picture_samples.h"
#include "ods/render/render_target.h"
#include "ods/render/renderer.h"

namespace ods {

// Tests that need a device, and skip without one.
class OnCard : public testing::Test {
 protected:
  void SetUp() override {
    const GpuList list = list_gpus();
    while (number < static_cast<int>(list.gpus.size()) && !list.gpus[static_cast<size_t>(number)].lacks.empty())
      number++;
    if (number < static_cast<int>(list.gpus.size())) {
      static const auto opened = std::make_shared<GpuDevice>(number);
      card = opened;
      return;
    }
    GTEST_SKIP() << "no Vulkan device can render: " << list.fault << "; the package mesa-vulkan-drivers has software";
  }

  // Skips a test of the whole kernel on software, which compiles it for minutes, unless ODS_WHOLE_KERNEL is set.
  void skip_on_software() const {
    if (card->info().kind != GpuKind::kSoftware || std::getenv("ODS_WHOLE_KERNEL") != nullptr) return;
    GTEST_SKIP() << "skipped: software Vulkan compiles this for minutes; ODS_WHOLE_KERNEL=1 runs it";
  }

  int number = 0;  // of the first device that can render
  std::shared_ptr<GpuDevice> card;
};

inline RenderOptions small_options() {
  RenderOptions options;
  options.width = 32;
  options.samples = 16;
  options.statistics = true;
  return with_height(options, StereoCamera{});
}

inline PictureSamples sampled(const Renderer& renderer, const StereoCamera& camera, const RenderOptions& options) {
  PictureSamples samples = no_samples(options);
  renderer.sample(std::span(&camera, 1), options, samples);
  return samples;
}

// The light of a block of one eye, and its variance.
struct BlockLight {
  double light = 0.0;
  double variance = 0.0;
};

inline BlockLight light_of(const PictureSamples& samples, const EyeSamples& eye, int x0, int y0) {
  BlockLight block;
  for (int y = y0; y < std::min(y0 + 8, samples.height); y++) {
    for (int x = x0; x < std::min(x0 + 8, samples.width); x++) {
      const auto pixel = static_cast<size_t>(y * samples.width + x);
      if (eye.count[pixel] == 0) continue;
      const vec3 variance = variance_of_mean(eye, pixel);
      block.variance += double{variance.x} + double{variance.y} + double{variance.z};
      for (size_t c = 0; c < 3; c++) {
        block.light += static_cast<double>(eye.light[3 * pixel + c]) / kLightUnit / eye.count[pixel];
      }
    }
  }
  return block;
}

// The difference of each block over its standard error, to which 1e-5 of the block's light is added: where there is no
// noise, last bits decide.
inline std::vector<double> z_of_blocks(const PictureSamples& a, const PictureSamples& b) {
  std::vector<double> z;
  for (size_t eye = 0; eye < a.eyes.size(); eye++) {
    for (int y = 0; y < a.height; y += 8) {
      for (int x = 0; x < a.width; x += 8) {
        const BlockLight one = light_of(a, a.eyes[eye], x, y), other = light_of(b, b.eyes[eye], x, y);
        z.push_back((other.light - one.light) / (std::sqrt(one.variance + other.variance) + 1e-5 * one.light + 1e-12));
      }
    }
  }
  return z;
}

// Both use the same random numbers, so most paths are the same, and z is smaller than for independent pictures.
inline void expect_same_light(const PictureSamples& cpu, const PictureSamples& gpu) {
  const std::vector<double> z = z_of_blocks(cpu, gpu);
  double sum = 0.0, squares = 0.0;
  for (const double each : z) {
    EXPECT_LT(std::abs(each), 4.5);
    sum += each, squares += each * each;
  }
  const auto count = static_cast<double>(z.size());
  EXPECT_LT(std::abs(sum / std::sqrt(count)), 4.0);
  EXPECT_LT(std::sqrt(squares / count), 1.3);
}

// The share of numbers that differ by more than a fraction of the larger one, and of 1.
template <typename Number>
double share_that_differs(const std::vector<Number>& a, const std::vector<Number>& b, double fraction) {
  size_t differ = 0;
  for (size_t i = 0; i < a.size(); i++) {
    const auto one = static_cast<double>(a[i]), other = static_cast<double>(b[i]);
    const double limit = fraction * std::max({std::abs(one), std::abs(other), 1.0});
    differ += one != other && !(std::abs(one - other) <= limit);
  }
  return a.empty() ? 0.0 : static_cast<double>(differ) / static_cast<double>(a.size());
}

// Rays that graze an edge, or meet two surfaces in one place, may see another surface.
inline void expect_same_first_hits(const PictureSamples& cpu, const PictureSamples& gpu) {
  constexpr double kGrazing = 0.02;
  for (size_t i = 0; i < cpu.eyes.size(); i++) {
    const EyeSamples &a = cpu.eyes[i], &b = gpu.eyes[i];
    EXPECT_LE(share_that_differs(a.depth, b.depth, 1e-3), kGrazing);
    EXPECT_LE(share_that_differs(a.normal, b.normal, 0.05), 4 * kGrazing);
    EXPECT_LE(share_that_differs(a.albedo, b.albedo, 0.05), 4 * kGrazing);
    EXPECT_LE(share_that_differs(a.hits, b.hits, 0.05), kGrazing);
    EXPECT_LE(share_that_differs(a.caught, b.caught, 0.05), kGrazing);
  }
}

// The sums by which noise is judged, over a whole eye.
inline void expect_same_statistics(const PictureSamples& cpu, const PictureSamples& gpu) {
  const auto sum_of = [](const auto& plane) {
    double sum = 0.0;
    for (const auto each : plane) sum += static_cast<double>(each);
    return sum;
  };
  for (size_t i = 0; i < cpu.eyes.size(); i++) {
    const EyeSamples &a = cpu.eyes[i], &b = gpu.eyes[i];
    EXPECT_NEAR(sum_of(b.squares), sum_of(a.squares), 0.05 * sum_of(a.squares));
    EXPECT_NEAR(sum_of(b.alone), sum_of(a.alone), 0.02 * sum_of(a.alone));
    EXPECT_NEAR(sum_of(b.weights), sum_of(a.weights), 0.02 * sum_of(a.weights));
    EXPECT_NEAR(sum_of(b.light_with), sum_of(a.light_with), 0.02 * sum_of(a.light_with));
    EXPECT_NEAR(sum_of(b.light_without), sum_of(a.light_without), 0.02 * sum_of(a.light_without));
  }
}

// Precondition: every pixel of both has all samples.
inline void expect_agreement(const PictureSamples& cpu, const PictureSamples& gpu, const std::string& name) {
  const testing::ScopedTrace trace(__FILE__, __LINE__, name);
  for (size_t i = 0; i < cpu.eyes.size(); i++) EXPECT_EQ(cpu.eyes[i].count, gpu.eyes[i].count);
  expect_same_light(cpu, gpu);
  expect_same_first_hits(cpu, gpu);
  expect_same_statistics(cpu, gpu);
}

}  // namespace ods
