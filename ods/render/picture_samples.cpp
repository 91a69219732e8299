// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/picture_samples.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "ods/render/render_target.h"
#include "ods/render/sampling_plan.h"

namespace ods {

double layer_unit(const RenderOptions& options) {
  return static_cast<double>(uint32_t{1} << (30 - std::bit_width(static_cast<uint32_t>(options.samples))));
}

static bool needs_squares(const RenderOptions& options) {
  return options.statistics || options.noise > 0.0f;
}

bool shares_paths(const RenderOptions& options) {
  return options.share_paths && options.eyes == Eyes::kBothEyes;
}

PictureSamples no_samples(const RenderOptions& options) {
  const int begin = samples_of_part(options).begin;
  PictureSamples samples{options.width, options.height, begin, begin, 0, {}, 0.0f, {}};
  samples.noisy.assign(block_count(options), kBothClasses);
  const size_t pixels = static_cast<size_t>(options.width) * static_cast<size_t>(options.height);
  for (const int eye : eye_list(options.eyes)) {
    EyeSamples& sums = samples.eyes.emplace_back();
    sums.eye = eye;
    sums.count.resize(pixels);
    sums.light.resize(3 * pixels);
    if (needs_squares(options)) sums.squares.resize(3 * pixels);
    if (needs_squares(options) && shares_paths(options)) sums.alone.resize(3 * pixels), sums.weights.resize(pixels);
    if (options.layers) {
      sums.normal.resize(3 * pixels);
      sums.albedo.resize(3 * pixels);
      sums.depth.resize(pixels, kFarDepth);
    }
    if (options.transparent) {
      sums.hits.resize(pixels);
      sums.caught.resize(pixels);
      sums.light_with.resize(pixels);
      sums.light_without.resize(pixels);
    }
  }
  return samples;
}

bool fit(const PictureSamples& samples, const RenderOptions& options) {
  const auto sizes = [](const EyeSamples& eye) {
    std::vector<size_t> list;
    each_plane(eye, [&](const char*, const auto& plane) { list.push_back(plane.size()); });
    return list;
  };
  RenderOptions small = options;
  small.width = small.height = 1;
  const PictureSamples one = no_samples(small);
  const size_t pixels = static_cast<size_t>(options.width) * static_cast<size_t>(options.height);
  bool fits = samples.width == options.width && samples.height == options.height;
  fits = fits && samples.noisy.size() == block_count(options) && samples.eyes.size() == one.eyes.size();
  const SampleRange range = samples_of_part(options);
  fits = fits && range.begin <= samples.done && samples.done <= samples.pass_to && samples.pass_to <= range.end;
  const size_t blocks = samples.noisy.size() * samples.eyes.size();
  fits = fits && samples.blocks_done >= 0 && static_cast<size_t>(samples.blocks_done) <= blocks;
  for (size_t i = 0; fits && i < one.eyes.size(); i++) {
    std::vector<size_t> wanted = sizes(one.eyes[i]);
    for (size_t& size : wanted) size *= pixels;
    fits = samples.eyes[i].eye == one.eyes[i].eye && sizes(samples.eyes[i]) == wanted;
  }
  return fits;
}

uint64_t count_samples(const PictureSamples& samples) {
  uint64_t sum = 0;
  for (const EyeSamples& eye : samples.eyes) sum = std::accumulate(eye.count.begin(), eye.count.end(), sum);
  return sum;
}

size_t samples_bytes(const RenderOptions& options) {
  const size_t count = sizeof(uint32_t), light = 3 * sizeof(int64_t), squares = 3 * sizeof(double);
  const size_t alone = shares_paths(options) ? 3 * sizeof(int64_t) + sizeof(uint32_t) : 0;
  const size_t layers = 6 * sizeof(int32_t) + sizeof(float), catchers = 2 * sizeof(uint32_t) + 2 * sizeof(int64_t);
  const size_t pixel = count + light + (needs_squares(options) ? squares + alone : 0) + (options.layers ? layers : 0) +
                       (options.transparent ? catchers : 0);
  return eye_list(options.eyes).size() * static_cast<size_t>(options.width) * static_cast<size_t>(options.height) *
         pixel;
}

// Rounds to 16 binary digits, which do not depend on the order in which the squares were added.
static float rounded(double variance) {
  int exponent = 0;
  const double digits = std::frexp(variance, &exponent);
  return static_cast<float>(std::ldexp(std::rint(std::ldexp(digits, 16)), exponent - 16));
}

// The square of the difference between a pixel's light and the light of its own samples, beyond their variance. Both
// have the same expectation, so the rest is noise from the other eye's paths: a bright sample that is not among the
// squares.
static double received_variance(double light, double alone, double variance) {
  constexpr double kExpected = 9.0;  // in variances: three standard deviations
  const double apart = light - alone;
  return std::max(apart * apart - kExpected * variance, 0.0);
}

// The variance of a sample over the number of samples; with shared paths each sample has a weight, and light comes from
// more samples.
vec3 variance_of_mean(const EyeSamples& eye, size_t pixel) {
  const double count = eye.count[pixel];
  if (count < 2.0) return vec3(0.0f);
  const std::vector<int64_t>& sums = eye.alone.empty() ? eye.light : eye.alone;
  const double weights = eye.weights.empty() ? count : eye.weights[pixel] / double{kWeightUnit};
  vec3 variance(0.0f);
  for (int c = 0; c < 3; c++) {
    const size_t at = 3 * pixel + static_cast<size_t>(c);
    const double mean = static_cast<double>(sums[at]) / (kLightUnit * count);
    const double difference = eye.squares[at] - mean * mean * count;
    const bool is_noisy = difference > 1e-12 * eye.squares[at];  // otherwise the rounding error of equal samples
    const double own = is_noisy ? difference / (count - 1.0) * weights / (count * count) : 0.0;
    const double light = static_cast<double>(eye.light[at]) / (kLightUnit * count);
    variance[c] = rounded(own + received_variance(light, mean, own));
  }
  return variance;
}

static float alpha_of(const EyeSamples& eye, size_t pixel) {
  double covered = eye.hits[pixel];
  const double with = static_cast<double>(eye.light_with[pixel]);
  const double without = static_cast<double>(eye.light_without[pixel]);
  if (without > 0.0) covered += eye.caught[pixel] * (1.0 - with / without);
  return static_cast<float>(covered / std::max(eye.count[pixel], 1u));
}

static void develop_pixel(const EyeSamples& eye, size_t pixel, double unit, EyeImage& image) {
  const double count = std::max(eye.count[pixel], 1u);
  for (size_t at = 3 * pixel; at < 3 * pixel + 3; at++) {
    image.radiance.pixels[at] = static_cast<float>(static_cast<double>(eye.light[at]) / (kLightUnit * count));
    if (eye.normal.empty()) continue;
    image.normal.pixels[at] = static_cast<float>(eye.normal[at] / (unit * count));
    image.albedo.pixels[at] = static_cast<float>(eye.albedo[at] / (unit * count));
  }
  if (!eye.hits.empty()) image.alpha.pixels[pixel] = alpha_of(eye, pixel);
  if (!eye.depth.empty()) {
    const float depth = eye.depth[pixel];
    const bool shadowed = eye.hits.empty() || image.alpha.pixels[pixel] > 0.0f;
    image.depth.pixels[pixel] = depth >= 0.0f ? depth : shadowed ? -depth : kFarDepth;
  }
  if (image.variance.pixels.empty()) return;
  const vec3 variance = variance_of_mean(eye, pixel);
  for (int c = 0; c < 3; c++) image.variance.pixels[3 * pixel + static_cast<size_t>(c)] = variance[c];
  image.samples.pixels[pixel] = static_cast<float>(eye.count[pixel]);
}

Picture develop(PictureSamples samples, const RenderOptions& options) {
  Picture picture;
  picture.samples_taken = static_cast<double>(count_samples(samples));
  const double unit = layer_unit(options);
  const size_t width = static_cast<size_t>(samples.width);
  for (EyeSamples& eye : samples.eyes) {
    EyeImage& image = picture.eyes.emplace_back(blank_eye(options, eye.eye));
    // In the middle of a pass, an eye has not received all the light for which its own was reduced.
    if (samples.blocks_done > 0 && !eye.alone.empty()) eye.light = std::move(eye.alone), eye.alone.clear();
    tbb::parallel_for(0, samples.height, [&](int y) {
      const size_t row = static_cast<size_t>(y) * width;
      for (size_t x = 0; x < width; x++) develop_pixel(eye, row + x, unit, image);
    });
    eye = {};  // large pictures do not fit in memory twice
  }
  return picture;
}

}  // namespace ods
