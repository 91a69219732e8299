// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Judging random numbers in tests. Seeds are fixed, so a test that passes once passes always.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "ods/kernel/math.h"

namespace ods {

// Independent uniform numbers in [0, 1) that no part of the kernel makes.
struct Dice {
  std::mt19937 engine;
  explicit Dice(uint seed) : engine(seed) {}
  float next() { return static_cast<float>(engine() >> 8) * (1.0f / 16777216.0f); }
  vec2 pair() {
    const float x = next();
    return vec2(x, next());
  }
  float between(float low, float high) { return low + (high - low) * next(); }
};

// Regularised upper incomplete gamma function Q(a, x): a series below x = a + 1, a continued fraction above.
inline double upper_gamma(double a, double x) {
  if (x <= 0.0) return 1.0;
  const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (int n = 1; n < 10000 && term > sum * 1e-16; n++) sum += term *= x / (a + n);
    return 1.0 - sum * scale;
  }
  double b = x + 1.0 - a, c = 1e300, d = 1.0 / b, fraction = d;
  for (int n = 1; n < 10000; n++) {
    const double an = -n * (n - a);
    b += 2.0;
    d = 1.0 / (an * d + b);
    c = b + an / c;
    fraction *= d * c;
    if (std::abs(d * c - 1.0) < 1e-15) break;
  }
  return scale * fraction;
}

// The chance that counts drawn from these expectations differ from them at least as much as these do. Cells that
// expect fewer than 5 are thrown together. Nothing may fall where nothing is expected.
inline double chi_square_p(const std::vector<double>& counts, const std::vector<double>& expected) {
  double statistic = 0.0, few = 0.0, few_expected = 0.0;
  int cells = 0;
  for (size_t i = 0; i < counts.size(); i++) {
    if (expected[i] < 5.0) {
      few += counts[i];
      few_expected += expected[i];
      continue;
    }
    statistic += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
    cells++;
  }
  if (few_expected >= 5.0) {
    statistic += (few - few_expected) * (few - few_expected) / few_expected;
    cells++;
  } else if (few > few_expected + 10.0 * std::sqrt(few_expected + 1.0)) {
    return 0.0;
  }
  return cells > 1 ? upper_gamma(0.5 * (cells - 1), 0.5 * statistic) : 1.0;
}

// Sidak: the p-value below which one of n tests fails, when all together may fail by chance once in a thousand.
inline double significance(int tests) {
  return 1.0 - std::pow(1.0 - 1e-3, 1.0 / tests);
}

// Mean and variance of that mean, one number at a time.
struct Mean {
  double sum = 0.0, squares = 0.0;
  int count = 0;
  void add(double x) { sum += x, squares += x * x, count++; }
  double value() const { return sum / count; }
  double variance() const { return std::max(squares / count - value() * value(), 0.0) / (count - 1); }
};

}  // namespace ods
