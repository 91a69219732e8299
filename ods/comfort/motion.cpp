// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/comfort/motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "ods/base/median.h"
#include "ods/disparity/match.h"
#include "ods/picture/picture.h"

namespace ods {

namespace {

constexpr size_t kUnknowns = 6;  // turn, velocity
using Row = std::array<double, kUnknowns>;

// One component of the motion of one place.
struct Equation {
  Row row;
  double moved;
};

glm::dvec3 direction_of(double theta, double phi) {
  return {std::cos(phi) * std::sin(theta), std::sin(phi), -std::cos(phi) * std::cos(theta)};
}

float depth_at(const Image& depth, double theta, double phi) {
  const double pi = 3.14159265358979;
  const int x = static_cast<int>((theta / (2.0 * pi) + 0.5) * depth.width);
  const int y = static_cast<int>((0.5 - phi / pi) * depth.height);
  return *depth.at(std::clamp(x, 0, depth.width - 1), std::clamp(y, 0, depth.height - 1));
}

// Along the tangents to the right and upwards.
void add_place(const Match& match, double nearness, std::vector<Equation>& equations) {
  const double theta = static_cast<double>(match.theta), phi = static_cast<double>(match.phi);
  const glm::dvec3 u = direction_of(theta, phi);
  const glm::dvec3 moved =
      direction_of(theta - static_cast<double>(match.around), phi - static_cast<double>(match.down)) - u;
  const glm::dvec3 right(std::cos(theta), 0.0, std::sin(theta)), up = glm::cross(right, u);
  for (const glm::dvec3& tangent : {right, up}) {
    const glm::dvec3 turned = -glm::cross(u, tangent), carried = -nearness * tangent;
    equations.push_back({{turned.x, turned.y, turned.z, carried.x, carried.y, carried.z}, glm::dot(moved, tangent)});
  }
}

double rest_of(const Equation& equation, const Row& solution) {
  double rest = equation.moved;
  for (size_t i = 0; i < kUnknowns; i++) rest -= equation.row[i] * solution[i];
  return rest;
}

// Weighted least squares by elimination; a small weight on 0 keeps a velocity that nothing shows at 0.
Row solve(const std::vector<Equation>& equations, const Row& before, double spread) {
  std::array<std::array<double, kUnknowns + 1>, kUnknowns> a{};
  for (const Equation& equation : equations) {
    const double off = rest_of(equation, before) / (2.0 * spread), weight = 1.0 / (1.0 + off * off);
    for (size_t i = 0; i < kUnknowns; i++) {
      for (size_t j = 0; j < kUnknowns; j++) a[i][j] += weight * equation.row[i] * equation.row[j];
      a[i][kUnknowns] += weight * equation.row[i] * equation.moved;
    }
  }
  for (size_t i = 0; i < kUnknowns; i++) a[i][i] += 1e-6 * static_cast<double>(equations.size());
  for (size_t i = 0; i < kUnknowns; i++) {
    const double pivot = a[i][i];
    for (double& value : a[i]) value /= pivot;
    for (size_t k = 0; k < kUnknowns; k++) {
      const double factor = a[k][i];
      for (size_t j = 0; k != i && j <= kUnknowns; j++) a[k][j] -= factor * a[i][j];
    }
  }
  Row solution;
  for (size_t i = 0; i < kUnknowns; i++) solution[i] = a[i][kUnknowns];
  return solution;
}

}  // namespace

ViewerMotion motion_between(const GrayView& before, const GrayView& after, const Image& depth, double seconds) {
  Search search;
  search.around = search.down = 0.12f;
  search.lowest = -1.0f;
  search.highest = 1.0f;
  const Matches matches = match_tiles(before, after, search);
  std::vector<Equation> equations;
  for (const Match& match : matches.found) {
    const float there = depth_at(depth, static_cast<double>(match.theta), static_cast<double>(match.phi));
    if (there > 0.0f) add_place(match, is_surface(there) ? 1.0 / static_cast<double>(there) : 0.0, equations);
  }
  ViewerMotion motion;
  if (equations.size() < 2 * kMinPlaces) return motion;
  Row solution{};
  const double minimum = 0.1 * static_cast<double>(matches.pixel);
  for (int i = 0; i < 12; i++) {
    std::vector<double> rests;
    for (const Equation& equation : equations) rests.push_back(std::abs(rest_of(equation, solution)));
    const double spread = std::max(1.48 * median(std::move(rests)), minimum);
    solution = solve(equations, solution, spread);
  }
  const double alike = 3.0 * minimum;
  motion.places =
      static_cast<int>(std::ranges::count_if(
                           equations, [&](const Equation& each) { return std::abs(rest_of(each, solution)) < alike; }) /
                       2);
  if (motion.places < kMinPlaces) return motion;
  motion.turn = glm::dvec3(solution[0], solution[1], solution[2]) / seconds;
  motion.velocity = glm::dvec3(solution[3], solution[4], solution[5]) / seconds;
  return motion;
}

}  // namespace ods
