// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The tree by which lights are picked: its probabilities match its picks, and it prefers lights that contribute.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "ods/kernel/light.h"
#include "ods/render/cpu/render.h"
#include "ods/render/lights.h"
#include "tests/support/pictures.h"

namespace ods {
namespace {

vec3 direction(Dice& dice) {
  const float z = dice.between(-1.0f, 1.0f), angle = dice.between(0.0f, 6.2831853f);
  const float r = std::sqrt(1.0f - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

TreeLight point_light(int number, vec3 position, double power = 1.0) {
  return {number, {position, position}, vec3(0, 0, 1), std::numbers::pi, power, 0.0};
}

// Points, spots, panels that shine to one side and to both.
std::vector<TreeLight> some_lights(int count, uint seed) {
  Dice dice(seed);
  std::vector<TreeLight> lights;
  for (int i = 0; i < count; i++) {
    const vec3 at(dice.between(-3, 3), dice.between(-1, 2), dice.between(-3, 3));
    TreeLight light = point_light(i, at, double{dice.between(0.1f, 5.0f)});
    if (i % 4 != 0) light.axis = direction(dice), light.open = i % 4 == 1 ? 0.6 : 0.0;
    if (i % 4 > 1) light.bounds.high += vec3(0.2f, 0.1f, 0.3f);
    if (i % 4 == 3) light.back_power = light.power;
    lights.push_back(light);
  }
  return lights;
}

struct Tree {
  explicit Tree(const std::vector<TreeLight>& lights) : tree(make_light_tree(lights, lights.size())) {
    kernel.light_nodes = tree.nodes.data();
  }
  double probability(size_t light, Receiver receiver) {
    return double{kernel.probability_in_tree(tree.ways[light], receiver)};
  }
  LightTree tree;
  LightSampler kernel;
};

TEST(LightTree, ProbabilitiesSumToOne) {
  for (const int count : {1, 2, 3, 40, 1000}) {
    Tree tree(some_lights(count, 3));
    Dice dice(5);
    for (int i = 0; i < 50; i++) {
      const vec3 normal = i % 3 == 0 ? vec3(0.0f) : direction(dice);
      const Receiver receiver{vec3(dice.between(-6, 6), dice.between(-6, 6), dice.between(-6, 6)), normal};
      double sum = 0.0;
      for (size_t k = 0; k < static_cast<size_t>(count); k++) sum += tree.probability(k, receiver);
      EXPECT_NEAR(sum, 1.0, 1e-5) << count;
    }
  }
}

TEST(LightTree, PicksAsOftenAsItSays) {
  constexpr int kCount = 40, kPicks = 200000;
  Tree tree(some_lights(kCount, 4));
  Dice dice(6);
  for (int i = 0; i < 8; i++) {
    const Receiver receiver{vec3(dice.between(-3, 3), dice.between(-2, 2), dice.between(-3, 3)),
                            i == 0 ? vec3(0.0f) : direction(dice)};
    std::vector<double> counts(kCount), expected(kCount);
    for (size_t k = 0; k < kCount; k++) expected[k] = kPicks * tree.probability(k, receiver);
    for (int n = 0; n < kPicks; n++) {
      const TreePick pick = tree.kernel.pick_in_tree(receiver, dice.next());
      ASSERT_NEAR(pick.probability / tree.probability(static_cast<size_t>(pick.light), receiver), 1.0, 1e-6);
      counts[static_cast<size_t>(pick.light)]++;
    }
    EXPECT_GT(chi_square_p(counts, expected), significance(8)) << i;
  }
}

TEST(LightTree, PrefersNearLights) {
  Tree tree({point_light(0, vec3(0, 2, 0)), point_light(1, vec3(0, -6, 0), 4.5)});
  const Receiver receiver{vec3(0.0f), vec3(0.0f)};
  EXPECT_NEAR(tree.probability(0, receiver), 2.0 / 3.0, 1e-6);  // 1 / 4 against 4.5 / 36
  EXPECT_NEAR(tree.probability(1, receiver), 1.0 / 3.0, 1e-6);
}

// Two panels below a ceiling, one of which faces it, and one behind a floor.
TEST(LightTree, PrefersLightsThatFaceTheSurfaceAndThatItFaces) {
  TreeLight down = point_light(0, vec3(1, 2, 0));
  TreeLight up = point_light(1, vec3(-1, 2, 0));
  down.open = up.open = 0.0;
  down.axis = vec3(0, -1, 0), up.axis = vec3(0, 1, 0);
  Tree lamps({down, up});
  const Receiver floor{vec3(0.0f), vec3(0, 1, 0)};
  EXPECT_EQ(lamps.probability(0, floor), 1.0);
  EXPECT_EQ(lamps.probability(1, floor), 0.0);
  up.back_power = 0.5;
  Tree both({down, up});
  EXPECT_NEAR(both.probability(1, floor), 1.0 / 3.0, 1e-6);
  Tree points({point_light(0, vec3(0, 2, 0)), point_light(1, vec3(0, -2, 0))});
  EXPECT_GT(points.probability(0, floor), 0.9);
  EXPECT_GT(points.probability(1, floor), 0.0);
}

// Every light is at the end of its way, however unlike they are, and the same lights make the same tree.
TEST(LightTree, HoldsEveryLight) {
  std::vector<TreeLight> lights;
  for (int i = 0; i < 5000; i++) {
    const float far = std::ldexp(1.0f, i % 60 - 20);
    lights.push_back(point_light(i, i % 7 == 0 ? vec3(0.0f) : vec3(far, 0, static_cast<float>(i)), 1.0 + i));
  }
  const Tree tree(lights), again(lights);
  std::set<int> found;
  for (size_t i = 0; i < lights.size(); i++) {
    int node = 0;
    for (uint bits = tree.tree.ways[i].bits; tree.tree.nodes[static_cast<size_t>(node)].child >= 0; bits >>= 1) {
      node = tree.tree.nodes[static_cast<size_t>(node)].child + static_cast<int>(bits & 1u);
    }
    EXPECT_EQ(-1 - tree.tree.nodes[static_cast<size_t>(node)].child, static_cast<int>(i));
    found.insert(node);
  }
  EXPECT_EQ(found.size(), lights.size());
  for (size_t i = 0; i < lights.size(); i++) EXPECT_EQ(tree.tree.ways[i].bits, again.tree.ways[i].bits);
  EXPECT_TRUE(make_light_tree({}, 3).nodes.empty());
}

// A white floor under many small lights of every kind: the sum of what each brings, in closed form.
TEST(LightTree, ManyPointsLightAFloor) {
  Scene scene;
  Material white = default_material();
  white.base_color = vec4(1.0f);
  white.ior = 1.0f;
  white.double_sided = 1;
  add_rectangle(scene, vec3(-50, -1, 50), vec3(100, 0, 0), vec3(0, 0, -100), add_material(scene, white));
  Dice dice(8);
  for (int i = 0; i < 200; i++) {
    PunctualLight light;
    light.kind = kLightPoint;
    light.position = vec3(dice.between(-8, 8), dice.between(0, 2), dice.between(-8, 8));
    light.intensity = vec3(dice.between(0.1f, 1.0f));
    scene.lights.push_back(light);
  }
  RenderOptions options = small_render(32, 256);
  options.bounces = 1;
  const Image image = render_cpu(scene, StereoCamera{}, options).eyes[0].radiance;
  Mean ratio;
  for (int y = 10; y < 16; y++) {
    for (int x = 0; x < 32; x++) {
      const double expected = pixel_mean(32, x, y, [&](glm::dvec3 w) {
        if (w.y >= 0.0) return 0.0;
        const glm::dvec3 at = w * (-1.0 / w.y);
        double sum = 0.0;
        for (const PunctualLight& light : scene.lights) {
          const glm::dvec3 to = glm::dvec3(light.position) - at;
          sum += double{light.intensity.x} * to.y / std::pow(glm::length(to), 3.0) / std::numbers::pi;
        }
        return sum;
      });
      ratio.add(double{image.at(x, y)[0]} / expected);
    }
  }
  EXPECT_NEAR(ratio.value(), 1.0, 0.01);
}

}  // namespace
}  // namespace ods
