// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "ods/base/error.h"

namespace ods {

static std::string shape_of(const std::vector<Image>& eyes) {
  if (eyes.empty()) return "no eyes";
  return fmt::format("{} eye{} of {}x{} pixels and {} channels", eyes.size(), eyes.size() == 1 ? "" : "s",
                     eyes[0].width, eyes[0].height, eyes[0].channels);
}

static void check_same_shape(const std::vector<Image>& a, const std::vector<Image>& b,
                             const std::array<std::string, 2>& names) {
  const auto is_same = [](const Image& one, const Image& other) {
    return one.width == other.width && one.height == other.height && one.channels == other.channels;
  };
  if (std::ranges::equal(a, b, is_same)) return;
  throw Error(ErrorKind::kInput, fmt::format("{} has {}, {} has {}: only pictures of the same size can be compared",
                                             names[0], shape_of(a), names[1], shape_of(b)));
}

static bool is_finite(const float* pixel, int channels) {
  return std::all_of(pixel, pixel + channels, [](float value) { return std::isfinite(value); });
}

namespace {

struct Sums {
  double squares = 0.0, count = 0.0;
  double weighted_squares = 0.0, weights = 0.0;
  LargestError largest;
  int64_t not_finite = 0;
};

}  // namespace

static Sums sum_errors(const Image& a, const Image& b, int eye) {
  Sums sums;
  for (int y = 0; y < a.height; y++) {
    double squares = 0.0, count = 0.0;
    for (int x = 0; x < a.width; x++) {
      const float *pa = a.at(x, y), *pb = b.at(x, y);
      if (!is_finite(pa, a.channels) || !is_finite(pb, a.channels)) {
        sums.not_finite++;
        continue;
      }
      for (int c = 0; c < a.channels; c++) {
        const double error = double{pb[c]} - double{pa[c]};
        squares += error * error;
        if (std::abs(error) > sums.largest.error) sums.largest = {std::abs(error), eye, x, y, c};
      }
      count += a.channels;
    }
    const double weight = std::cos((y + 0.5 - 0.5 * a.height) * std::numbers::pi / a.height);
    sums.squares += squares;
    sums.count += count;
    sums.weighted_squares += weight * squares;
    sums.weights += weight * count;
  }
  sums.largest.eye = eye;
  return sums;
}

static void add(Sums& whole, const Sums& part) {
  whole.squares += part.squares;
  whole.count += part.count;
  whole.weighted_squares += part.weighted_squares;
  whole.weights += part.weights;
  whole.not_finite += part.not_finite;
  if (part.largest.error > whole.largest.error) whole.largest = part.largest;
}

static Errors errors_of(const Sums& sums) {
  if (sums.count == 0.0) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan, nan, sums.largest, sums.not_finite};
  }
  const double mean = sums.squares / sums.count;
  return {std::sqrt(mean), -10.0 * std::log10(mean), -10.0 * std::log10(sums.weighted_squares / sums.weights),
          sums.largest, sums.not_finite};
}

Comparison compare_eyes(const std::vector<Image>& a, const std::vector<Image>& b,
                        const std::array<std::string, 2>& names) {
  check_same_shape(a, b, names);
  Comparison comparison;
  Sums whole;
  for (size_t i = 0; i < a.size(); i++) {
    const Sums sums = sum_errors(a[i], b[i], static_cast<int>(i));
    comparison.eyes.push_back(errors_of(sums));
    add(whole, sums);
  }
  comparison.whole = errors_of(whole);
  return comparison;
}

Image difference(const Image& a, const Image& b) {
  assert(a.pixels.size() == b.pixels.size() && a.channels == b.channels);
  Image result(a.width, a.height, a.channels);
  for (int y = 0; y < a.height; y++) {
    for (int x = 0; x < a.width; x++) {
      const float *pa = a.at(x, y), *pb = b.at(x, y);
      if (!is_finite(pa, a.channels) || !is_finite(pb, a.channels)) continue;
      for (int c = 0; c < a.channels; c++) result.at(x, y)[c] = pb[c] - pa[c];
    }
  }
  return result;
}

ZTest z_test(const std::vector<Image>& a, const std::vector<Image>& b, const std::vector<Image>& variance_a,
             const std::vector<Image>& variance_b) {
  assert(a.size() == b.size() && a.size() == variance_a.size() && a.size() == variance_b.size());
  ZTest test;
  double sum = 0.0, squares = 0.0;
  int64_t beyond = 0;
  for (size_t i = 0; i < a.size(); i++) {
    for (size_t j = 0; j < a[i].pixels.size(); j++) {
      const double error = double{b[i].pixels[j]} - double{a[i].pixels[j]};
      const double variance = double{variance_a[i].pixels[j]} + double{variance_b[i].pixels[j]};
      if (!std::isfinite(error) || !std::isfinite(variance)) continue;
      if (variance <= 0.0) {
        test.sure_differences += error != 0.0 ? 1 : 0;
        continue;
      }
      const double z = error / std::sqrt(variance);
      test.values++;
      sum += z;
      squares += z * z;
      beyond += std::abs(z) > 3.0 ? 1 : 0;
      test.largest = std::max(test.largest, std::abs(z));
    }
  }
  if (test.values == 0) return test;
  const double count = static_cast<double>(test.values);
  test.mean = sum / count;
  test.rms = std::sqrt(squares / count);
  test.beyond_3 = static_cast<double>(beyond) / count;
  return test;
}

}  // namespace ods
