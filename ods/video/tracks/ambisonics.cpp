// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/tracks/ambisonics.h"

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace ods {

int ambisonic_order(int channels) {
  const int order = static_cast<int>(std::lround(std::sqrt(channels))) - 1;
  return order >= 0 && (order + 1) * (order + 1) == channels ? order : 0;
}

// The harmonics of a direction.
static std::vector<double> harmonics(int order, glm::dvec3 direction) {
  const glm::dvec3 d(-direction.z, -direction.x, direction.y);  // front, left, up
  const double azimuth = std::atan2(d.y, d.x), height = glm::clamp(d.z, -1.0, 1.0);
  std::vector<double> result;
  for (int l = 0; l <= order; l++) {
    for (int m = -l; m <= l; m++) {
      const int k = std::abs(m);
      const double scale = std::sqrt((k == 0 ? 1.0 : 2.0) * std::tgamma(l - k + 1.0) / std::tgamma(l + k + 1.0));
      const double around = m < 0 ? std::sin(k * azimuth) : std::cos(k * azimuth);
      result.push_back(scale * around *
                       std::assoc_legendre(static_cast<unsigned>(l), static_cast<unsigned>(k), height));
    }
  }
  return result;
}

namespace {

struct Node {
  double place = 0.0, weight = 0.0;
};

}  // namespace

// Gauss and Legendre's rule on [-1, 1], exact for polynomials of degree 2 * count - 1; weights add up to 1.
static std::vector<Node> gauss_legendre(int count) {
  const auto n = static_cast<unsigned>(count);
  std::vector<Node> nodes;
  for (int i = 0; i < count; i++) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 1.0;
    for (int step = 0; step < 20; step++) {
      slope = count * (x * std::legendre(n, x) - std::legendre(n - 1, x)) / (x * x - 1.0);
      x -= std::legendre(n, x) / slope;
    }
    nodes.push_back({x, 1.0 / ((1.0 - x * x) * slope * slope)});
  }
  return nodes;
}

// Harmonics are orthogonal, so the matrix is the mean, over all directions, of the harmonics of the turned direction
// times those of the direction, over the mean of their squares, 1 / (2 l + 1). The rule is exact for their products.
std::vector<double> ambisonic_turn(int order, const glm::dmat3& turn) {
  const auto channels = static_cast<size_t>((order + 1) * (order + 1));
  std::vector<double> matrix(channels * channels, 0.0);
  const int around = 2 * order + 1;
  for (const Node& node : gauss_legendre(order + 1)) {
    for (int i = 0; i < around; i++) {
      const double heading = 2.0 * std::numbers::pi * i / around, level = std::sqrt(1.0 - node.place * node.place);
      const glm::dvec3 direction(level * std::sin(heading), node.place, -level * std::cos(heading));
      const std::vector<double> before = harmonics(order, direction), after = harmonics(order, turn * direction);
      for (int l = 0; l <= order; l++) {
        const auto first = static_cast<size_t>(l * l), end = static_cast<size_t>((l + 1) * (l + 1));
        const double weight = (2 * l + 1) * node.weight / around;
        for (size_t row = first; row < end; row++) {
          for (size_t column = first; column < end; column++) {
            matrix[row * channels + column] += weight * after[row] * before[column];
          }
        }
      }
    }
  }
  return matrix;
}

}  // namespace ods
