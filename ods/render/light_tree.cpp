// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Builds the tree from which the kernel picks lights (ods/kernel/light.h).
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "ods/render/lights.h"

namespace ods {
namespace {

using glm::dvec3;
using std::numbers::pi;

constexpr int kBins = 12;     // candidates for a split, along each axis
constexpr int kDeepest = 31;  // LightWay has a bit for each level

struct Cone {
  dvec3 axis;
  double open;  // radians
};

Cone cone_around(Cone a, Cone b) {
  if (a.open < b.open) std::swap(a, b);
  if (a.open >= pi) return a;
  const double apart = std::acos(std::clamp(glm::dot(a.axis, b.axis), -1.0, 1.0));
  if (apart + b.open <= a.open) return a;
  const double open = 0.5 * (a.open + apart + b.open);
  const double sine = std::sin(apart);
  if (open >= pi || sine < 1e-9) return {a.axis, pi};
  const double turn = open - a.open;
  return {glm::normalize((std::sin(apart - turn) * a.axis + std::sin(turn) * b.axis) / sine), open};
}

// The common bounds of several lights.
struct Group {
  dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  Cone cone{dvec3(0.0, 0.0, 1.0), 0.0};
  double power = 0.0, back_power = 0.0;
  size_t count = 0;

  void add(const Group& other) {
    if (other.count == 0) return;
    cone = count == 0 ? other.cone : cone_around(cone, other.cone);
    low = glm::min(low, other.low), high = glm::max(high, other.high);
    power += other.power, back_power += other.back_power, count += other.count;
  }

  // The cost of these lights in one node: power times the solid angle in which they shine times the square of their
  // extent.
  double cost() const {
    if (count == 0) return 0.0;
    const double maximum = std::min(cone.open + 0.5 * pi, pi);
    const double angle = 2.0 * pi * (1.0 - std::cos(cone.open)) +
                         0.5 * pi *
                             (2.0 * maximum * std::sin(cone.open) - std::cos(cone.open - 2.0 * maximum) -
                              2.0 * cone.open * std::sin(cone.open) + std::cos(cone.open));
    return (power + back_power) * angle * glm::dot(high - low, high - low);
  }
};

Group group_of(const TreeLight& light) {
  return {dvec3(light.bounds.low),
          dvec3(light.bounds.high),
          {dvec3(light.axis), light.open},
          light.power,
          light.back_power,
          1};
}

dvec3 middle_of(const TreeLight& light) {
  return 0.5 * (dvec3(light.bounds.low) + dvec3(light.bounds.high));
}

// Lights below a plane, by their middle's coordinate, go to the first child.
struct Split {
  int axis = -1;  // -1 if there is no split
  double plane = 0.0;
};

Split best_split(std::span<const TreeLight> lights) {
  dvec3 low = middle_of(lights[0]), high = low;
  for (const TreeLight& light : lights) low = glm::min(low, middle_of(light)), high = glm::max(high, middle_of(light));
  const dvec3 size = high - low;
  const double longest = std::max({size.x, size.y, size.z});
  Split best;
  double minimum = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; axis++) {
    if (!(size[axis] > 0.0)) continue;
    Group bins[kBins];
    for (const TreeLight& light : lights) {
      const double place = (middle_of(light)[axis] - low[axis]) / size[axis];
      bins[std::min(static_cast<int>(place * kBins), kBins - 1)].add(group_of(light));
    }
    Group after[kBins];  // this bin and all behind it
    for (int i = kBins - 1; i >= 0; i--) {
      if (i < kBins - 1) after[i] = after[i + 1];
      after[i].add(bins[i]);
    }
    Group before;
    for (int i = 1; i < kBins; i++) {
      if (bins[i - 1].count == 0) continue;  // the same plane as before
      before.add(bins[i - 1]);
      if (after[i].count == 0) break;
      const double cost = longest / size[axis] * (before.cost() + after[i].cost());
      if (cost < minimum) minimum = cost, best = {axis, low[axis] + size[axis] * i / kBins};
    }
  }
  return best;
}

// Moves the first child's lights to the front. Returns their number, which is at least 1 and less than all.
size_t divide(std::span<TreeLight> lights, int depth) {
  const size_t half = lights.size() / 2;
  if (lights.size() == 2) return half;
  if (static_cast<int>(std::bit_width(lights.size() - 1)) >= kDeepest - depth) return half;
  const Split split = best_split(lights);
  if (split.axis < 0) return half;
  const auto first = std::stable_partition(
      lights.begin(), lights.end(), [&](const TreeLight& light) { return middle_of(light)[split.axis] < split.plane; });
  const auto count = static_cast<size_t>(first - lights.begin());
  return count == 0 || count == lights.size() ? half : count;
}

LightNode node_of(std::span<const TreeLight> lights) {
  Group all;
  for (const TreeLight& light : lights) all.add(group_of(light));
  LightNode node;
  node.center = vec3(0.5 * (all.low + all.high));
  node.radius = static_cast<float>(0.5 * glm::length(all.high - all.low));
  node.axis = vec3(all.cone.axis);
  node.spread = all.cone.open < 0.5 * pi ? static_cast<float>(std::sin(all.cone.open)) : 2.0f;
  node.power = static_cast<float>(all.power);
  node.back_power = static_cast<float>(all.back_power);
  node.child = -1 - lights[0].light;
  return node;
}

// Fills in the node at this index, which contains these lights, and all nodes below it.
void build(std::span<TreeLight> lights, size_t index, int depth, uint way, LightTree& tree) {
  tree.nodes[index] = node_of(lights);
  if (lights.size() == 1) {
    tree.ways[static_cast<size_t>(lights[0].light)] = {way};
    return;
  }
  const size_t first = divide(lights, depth), child = tree.nodes.size();
  tree.nodes[index].child = static_cast<int>(child);
  tree.nodes.resize(child + 2);
  build(lights.first(first), child, depth + 1, way, tree);
  build(lights.subspan(first), child + 1, depth + 1, way | 1u << depth, tree);
}

}  // namespace

LightTree make_light_tree(std::vector<TreeLight> lights, size_t count) {
  LightTree tree;
  tree.ways.resize(count);
  if (lights.empty()) return tree;
  tree.nodes.reserve(2 * lights.size());
  tree.nodes.resize(1);
  build(lights, 0, 0, 0u, tree);
  return tree;
}

}  // namespace ods
