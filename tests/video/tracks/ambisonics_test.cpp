// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/tracks/ambisonics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace ods {
namespace {

glm::dmat3 rotation(double degrees, glm::dvec3 axis) {
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), glm::radians(degrees), glm::normalize(axis)));
}

TEST(Ambisonics, OrdersAreSquares) {
  EXPECT_EQ(ambisonic_order(4), 1);
  EXPECT_EQ(ambisonic_order(16), 3);
  EXPECT_EQ(ambisonic_order(6), 0);
  EXPECT_EQ(ambisonic_order(1), 0);
}

// A source in direction d has W 1, Y its way to the left, Z up, X to the front, and of the second order ACN 4 to 8.
std::vector<double> source(glm::dvec3 d) {
  const double x = -d.z, y = -d.x, z = d.y, root = std::sqrt(3.0);
  return {1.0, y, z, x, root * x * y, root * y * z, 1.5 * z * z - 0.5, root * x * z, root / 2.0 * (x * x - y * y)};
}

TEST(Ambisonics, SourcesAreWhereTheTurnPutsThem) {
  const glm::dvec3 directions[] = {{0.0, 0.0, -1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.48, -0.6, 0.64}};
  const glm::dmat3 turns[] = {rotation(60.0, {0, 1, 0}), rotation(-35.0, {1, 0, 0}), rotation(20.0, {0, 0, 1}),
                              rotation(137.0, {0.3, -1.0, 0.5})};
  for (const glm::dmat3& turn : turns) {
    const std::vector<double> matrix = ambisonic_turn(2, turn);
    for (const glm::dvec3& direction : directions) {
      const std::vector<double> before = source(direction), after = source(turn * direction);
      for (size_t row = 0; row < 9; row++) {
        double sum = 0.0;
        for (size_t c = 0; c < 9; c++) sum += matrix[9 * row + c] * before[c];
        EXPECT_NEAR(sum, after[row], 1e-12) << row;
      }
    }
  }
}

// About the vertical, each pair of harmonics turns by its own multiple of the angle, whatever the order.
TEST(Ambisonics, AboutTheVerticalEachPairTurnsByItsMultiple) {
  const double angle = glm::radians(25.0);
  const int order = 7;
  const auto channels = static_cast<size_t>((order + 1) * (order + 1));
  const std::vector<double> matrix = ambisonic_turn(order, rotation(25.0, {0, 1, 0}));  // sources go to the left
  for (int l = 0; l <= order; l++) {
    for (int m = -l; m <= l; m++) {
      const auto row = static_cast<size_t>(l * l + l + m);
      for (size_t c = 0; c < channels; c++) {
        const auto pair = static_cast<size_t>(l * l + l - m);
        double wanted = c == row ? std::cos(m * angle) : 0.0;
        if (c == pair && m != 0) wanted = -std::sin(m * angle);
        if (m < 0 && c == pair) wanted = std::sin(-m * angle);
        EXPECT_NEAR(matrix[row * channels + c], wanted, 1e-11) << l << " " << m << " " << c;
      }
    }
  }
}

TEST(Ambisonics, TurnsCompose) {
  const glm::dmat3 a = rotation(40.0, {1, 2, 0}), b = rotation(-70.0, {0, 1, 3});
  const std::vector<double> first = ambisonic_turn(3, a), second = ambisonic_turn(3, b),
                            both = ambisonic_turn(3, b * a);
  for (size_t row = 0; row < 16; row++) {
    for (size_t column = 0; column < 16; column++) {
      double sum = 0.0;
      for (size_t k = 0; k < 16; k++) sum += second[16 * row + k] * first[16 * k + column];
      EXPECT_NEAR(sum, both[16 * row + column], 1e-12);
    }
  }
}

}  // namespace
}  // namespace ods
