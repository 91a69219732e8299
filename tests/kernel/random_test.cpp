// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/kernel/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "ods/kernel/filter.h"
#include "ods/kernel/light.h"
#include "ods/render/lights.h"
#include "ods/render/tables.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace ods::random_test {

TEST(RandomPair, EveryPowerOfTwoOfSamplesFillsEveryElementaryInterval) {
  for (uint seed : {0u, 1u, 77u, 0xffffffffu}) {
    for (uint dimension : {0u, 1u, 5u, 36u}) {
      for (int k = 0; k <= 10; k++) {
        for (int split = 0; split <= k; split++) {
          const int across = 1 << split, down = 1 << (k - split);
          std::vector<int> hits(size_t{1} << k);
          for (uint i = 0; i < (1u << k); i++) {
            const vec2 u = random_pair(seed, i, dimension);
            hits[static_cast<size_t>(static_cast<int>(u.x * static_cast<float>(across)) +
                                     static_cast<int>(u.y * static_cast<float>(down)) * across)]++;
          }
          for (int hit : hits) ASSERT_EQ(hit, 1) << seed << ' ' << dimension << ' ' << k << ' ' << split;
        }
      }
    }
  }
}

// The counts of pairs of two numbers in each of 8 x 8 boxes.
double independence_p(int n, const std::function<vec2(uint)>& both) {
  std::vector<double> counts(64), expected(64, n / 64.0);
  for (int i = 0; i < n; i++) {
    const vec2 u = both(static_cast<uint>(i));
    EXPECT_TRUE(u.x >= 0.0f && u.x < 1.0f && u.y >= 0.0f && u.y < 1.0f);
    counts[static_cast<size_t>(u.x * 8.0f) + 8 * static_cast<size_t>(u.y * 8.0f)]++;
  }
  return chi_square_p(counts, expected);
}

// One sample of each of many pixels is as good as random, and so are two dimensions, samples or eyes taken together.
TEST(RandomPair, PixelsAndDimensionsAreIndependent) {
  const int n = 1 << 16;
  const auto pixel = [](uint i) { return hash_pair(hash_pair(0u, 0u), i); };
  const auto other_eye = [](uint i) { return hash_pair(hash_pair(0u, 1u), i); };
  const double limit = significance(8);
  EXPECT_GT(independence_p(n, [&](uint i) { return random_pair(pixel(i), 0, 0); }), limit);
  EXPECT_GT(independence_p(n, [&](uint i) { return random_pair(pixel(i), 7, 3); }), limit);
  const auto x = [](uint seed, uint index, uint dimension) { return random_pair(seed, index, dimension).x; };
  EXPECT_GT(independence_p(n, [&](uint i) { return vec2(x(pixel(i), 0, 0), x(pixel(i + 1), 0, 0)); }), limit);
  EXPECT_GT(independence_p(n, [&](uint i) { return vec2(x(pixel(i), 0, 0), x(pixel(i + 2048), 0, 0)); }), limit);
  EXPECT_GT(independence_p(n, [&](uint i) { return vec2(x(pixel(i), 0, 0), x(other_eye(i), 0, 0)); }), limit);
  EXPECT_GT(independence_p(n, [&](uint i) { return vec2(x(pixel(i), 3, 1), x(pixel(i), 3, 2)); }), limit);
  EXPECT_GT(independence_p(n, [&](uint i) { return vec2(x(pixel(i), 3, 1), x(pixel(i), 3, 5)); }), limit);
  EXPECT_GT(independence_p(n, [&](uint i) { return vec2(x(pixel(i), 0, 2), random_pair(pixel(i), 0, 3).y); }), limit);
}

// Within one pixel the dimensions must not march in step.
TEST(RandomPair, DimensionsOfOnePixelAreUncorrelated) {
  const int n = 1024;
  for (uint a = 0; a < 12; a++) {
    for (uint b = a + 1; b < 12; b++) {
      double sum = 0.0;
      for (uint i = 0; i < n; i++) {
        sum += double{random_pair(9u, i, a).x - 0.5f} * double{random_pair(9u, i, b).x - 0.5f};
      }
      // The standard deviation of independent numbers' correlation is 1 / sqrt(n).
      EXPECT_LT(std::abs(sum / n * 12.0), 4.5 / std::sqrt(n)) << a << ' ' << b;
    }
  }
}

// A share u of the filter lies left of the offset that u gives: exactly for the box, within a thousandth
// for Blackman-Harris.
TEST(PixelFilter, HasItsShape) {
  FilterSampler filter;
  filter.tables = kernel_tables({.glass = true}).data();
  const double pi = std::acos(-1.0);
  const auto share_left = [&](double x) {
    const double t = 2.0 * pi * x / 3.0;
    return 0.5 + x / 3.0 +
           (0.48829 * std::sin(t) + 0.14128 * std::sin(2.0 * t) / 2.0 + 0.01168 * std::sin(3.0 * t) / 3.0) /
               (2.0 * pi * 0.35875);
  };
  for (int i = 0; i <= 100000; i++) {
    const float u = static_cast<float>(i) / 100000.0f;
    const float x = filter.filter_offset(kFilterBlackmanHarris, u);
    ASSERT_LE(std::abs(x), 1.5f);
    ASSERT_NEAR(share_left(double{x}), double{u}, 1e-3) << u;
    ASSERT_EQ(filter.filter_offset(kFilterBox, u), u - 0.5f);
  }
  EXPECT_EQ(filter.filtered_position(kFilterBox, 3, 1, 8, 4, vec2(0.5f)), vec2(3.5f / 8.0f, 1.5f / 4.0f));
}

// The table read back: what each entry keeps, and what others give it, add up to its weight.
TEST(AliasTable, GivesEveryEntryItsShare) {
  Dice dice(7);
  for (int n : {1, 2, 3, 10, 1000}) {
    std::vector<double> weights(static_cast<size_t>(n));
    double total = 0.0;
    for (double& w : weights) total += w = dice.next() < 0.3f ? 0.0 : std::exp(static_cast<double>(dice.next()) * 20.0);
    if (total == 0.0) weights[0] = total = 1.0;
    const std::vector<AliasEntry> table = make_alias_table(weights);
    std::vector<double> share(weights.size());
    for (size_t i = 0; i < share.size(); i++) {
      const double kept = static_cast<double>(table[i].threshold);
      ASSERT_TRUE(kept >= 0.0 && kept <= 1.0);
      share[i] += kept / n;
      share[static_cast<size_t>(table[i].alias)] += (1.0 - kept) / n;
    }
    for (size_t i = 0; i < share.size(); i++) {
      EXPECT_NEAR(share[i], weights[i] / total, 1e-7) << n;
      EXPECT_NEAR(static_cast<double>(table[i].probability), weights[i] / total, 1e-7);
      EXPECT_TRUE(weights[i] > 0.0 || share[i] == 0.0) << n;
    }
  }
  const std::vector<AliasEntry> dark = make_alias_table({0.0, 0.0});
  EXPECT_EQ(dark[0].probability, 0.5f);
  EXPECT_EQ(dark[1].probability, 0.5f);
}

// --- directions ----------------------------------------------------------------------------------------------------

// Cells of the sphere: rows of equal angle from +Z, so that z = 0 is an edge, and columns around.
struct SphereCells {
  int rows = 24;
  int columns = 24;

  size_t find(vec3 w) const {
    const double pi = std::acos(-1.0);
    const double turn = std::atan2(double{w.y}, double{w.x}) / (2.0 * pi) + 0.5;
    const double fall = std::acos(std::clamp(double{w.z}, -1.0, 1.0)) / pi;
    const int row = std::min(static_cast<int>(fall * rows), rows - 1);
    return static_cast<size_t>(row * columns + std::min(static_cast<int>(turn * columns), columns - 1));
  }

  // The integral of a density over each cell, by a jittered grid: densities jump where microfacets turn away.
  std::vector<double> integrate(int steps, const std::function<double(vec3)>& density) const {
    const double pi = std::acos(-1.0), row_angle = pi / rows / steps, column_angle = 2.0 * pi / columns / steps;
    std::vector<double> integral(static_cast<size_t>(rows * columns));
    Dice dice(11);
    for (int row = 0; row < rows * steps; row++) {
      for (int column = 0; column < columns * steps; column++) {
        const double theta = (row + double{dice.next()}) * row_angle;
        const double phi = (column + double{dice.next()}) * column_angle - pi;
        const vec3 w(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
        integral[static_cast<size_t>(row / steps * columns + column / steps)] +=
            density(w) * std::sin(theta) * row_angle * column_angle;
      }
    }
    return integral;
  }
};

constexpr int kDraws = 100000;

// The p-value of draws against the density they claim. A draw of length 0 is a lost one; they have a cell of their own.
double density_p(int steps, const std::function<double(vec3)>& density, const std::function<vec3(Dice&)>& draw) {
  const SphereCells cells;
  std::vector<double> expected = cells.integrate(steps, density), counts(expected.size() + 1);
  double total = 0.0;
  for (double& e : expected) total += e, e *= kDraws;
  EXPECT_LT(total, 1.0 + 2e-3);
  expected.push_back(std::max(1.0 - total, 0.0) * kDraws);
  Dice dice(8);
  for (int i = 0; i < kDraws; i++) {
    const vec3 w = draw(dice);
    counts[w == vec3(0.0f) ? expected.size() - 1 : cells.find(w)]++;
  }
  return chi_square_p(counts, expected);
}

vec3 viewer(float degrees) {
  return vec3(std::sin(glm::radians(degrees)), 0.0f, std::cos(glm::radians(degrees)));
}

TEST(Density, VisibleNormals) {
  for (float alpha : {0.1f, 0.3f, 0.6f, 1.0f}) {
    for (float angle : {0.0f, 40.0f, 75.0f, 88.0f}) {
      const vec3 wo = viewer(angle);
      const double p = density_p(
          16, [&](vec3 h) { return h.z > 0.0f ? double{ggx_visible_pdf(wo, h, alpha)} : 0.0; },
          [&](Dice& dice) { return ggx_sample_visible(wo, alpha, dice.pair()); });
      EXPECT_GT(p, significance(16)) << alpha << ' ' << angle;
    }
  }
}

Surface plain_surface(float roughness) {
  Surface surface{};
  surface.geometric = surface.normal = vec3(0.0f, 0.0f, 1.0f);
  surface.front = true;
  surface.base_color = vec3(0.8f, 0.5f, 0.3f);
  surface.roughness = roughness;
  surface.ior = 1.5f;
  return surface;
}

struct Lobe {
  const char* name;
  float metallic, transmission;
  bool volume;
  float eta;
};

TEST(Density, EveryLobe) {
  BsdfEvaluator kernel;
  kernel.tables = kernel_tables({.glass = true}).data();
  const Lobe lobes[] = {{"diffuse and gloss", 0, 0, false, 1.5f},    {"metal", 1, 0, false, 1.5f},
                        {"thin glass", 0, 1, false, 1.5f},           {"glass from outside", 0, 1, true, 1.5f},
                        {"glass from inside", 0, 1, true, 1 / 1.5f}, {"glass to water", 0, 1, true, 1.33f / 1.5f},
                        {"everything", 0.3f, 0.5f, true, 1.5f}};
  for (const Lobe& lobe : lobes) {
    for (float roughness : {0.5f, 0.75f, 1.0f}) {
      for (float angle : {5.0f, 50.0f, 80.0f}) {
        Surface surface = plain_surface(roughness);
        surface.metallic = lobe.metallic;
        surface.transmission = lobe.transmission;
        surface.volume = lobe.volume;
        const Bsdf bsdf = kernel.make_bsdf(surface, -viewer(angle), lobe.eta);
        const double p = density_p(
            24, [&](vec3 w) { return double{kernel.bsdf_value(bsdf, w).pdf}; },
            [&](Dice& dice) {
              const float pick = dice.next();
              const BsdfSample found = kernel.sample_bsdf(bsdf, pick, dice.pair());
              if (found.pdf <= 0.0f) return vec3(0.0f);
              EXPECT_EQ(found.through, found.direction.z < 0.0f);
              const BsdfValue value = kernel.bsdf_value(bsdf, found.direction);
              EXPECT_EQ(value.pdf, found.pdf);
              EXPECT_LE(length(value.value - found.weight * found.pdf), 1e-5f * length(value.value));
              return found.direction;
            });
        EXPECT_GT(p, significance(63)) << lobe.name << ' ' << roughness << ' ' << angle;
      }
    }
  }
}

// A lamp of two triangles and a picture of the sky.
Scene lit_scene() {
  Scene scene;
  Material lamp = default_material();
  lamp.emission = vec3(2.0f, 3.0f, 1.0f);
  add_rectangle(scene, vec3(-1, -1, 1.5f), vec3(2, 0, 0.5f), vec3(0, 2, 0), add_material(scene, lamp));
  scene.environment.radiance = vec3(1.0f);
  scene.environment.width = 12;
  scene.environment.height = 6;
  Dice dice(9);
  for (int i = 0; i < 72; i++) scene.environment.texels.push_back(vec3(dice.next() < 0.2f ? 20.0f : 0.1f));
  return scene;
}

const Receiver kHere{vec3(0.0f), vec3(0.0f)};

LightSampler reader_of(const Scene& scene, const LightTable& table) {
  LightSampler kernel;
  set_scene(kernel, scene, table);
  return kernel;
}

// The point where a ray from the origin hits the lamp, if it does; straight from the definition.
Hit meet_lamp(const LightSampler& kernel, vec3 w) {
  Hit hit{-1.0f, 0.0f, 0.0f, 0, 0};
  for (int i = 0; i < 2; i++) {
    const uvec3 corners = kernel.scene_triangle(static_cast<uint>(i));
    const vec3 a = kernel.scene_vertex(corners.x).position;
    const vec3 ab = kernel.scene_vertex(corners.y).position - a, ac = kernel.scene_vertex(corners.z).position - a;
    const glm::dvec3 solved = glm::inverse(glm::dmat3(glm::dvec3(w), -glm::dvec3(ab), -glm::dvec3(ac))) * glm::dvec3(a);
    if (solved.x > 0.0 && solved.y >= 0.0 && solved.z >= 0.0 && solved.y + solved.z <= 1.0) {
      return Hit{static_cast<float>(solved.x), static_cast<float>(solved.y), static_cast<float>(solved.z), 0, i};
    }
  }
  return hit;
}

TEST(Density, Lights) {
  const Scene scene = lit_scene();
  const LightTable table = make_lights(scene);
  ASSERT_EQ(table.lights.size(), 3u);
  LightSampler kernel = reader_of(scene, table);
  const auto draw = [&](Dice& dice, bool environment) {
    const vec2 pick = dice.pair();
    const LightSample light = kernel.sample_light(kHere, pick, dice.pair(), dice.pair());
    return light.valid && (light.distance > 1e29f) == environment ? light.direction : vec3(0.0f);
  };
  const auto triangles = [&](vec3 w) {
    const Hit hit = meet_lamp(kernel, w);
    return hit.t < 0.0f ? 0.0 : double{kernel.hit_light_pdf(hit, kHere, w, hit.t)};
  };
  const auto environment = [&](vec3 w) { return double{kernel.environment_pdf(vec3(0.0f), w)}; };
  EXPECT_GT(density_p(32, triangles, [&](Dice& dice) { return draw(dice, false); }), significance(2));
  EXPECT_GT(density_p(32, environment, [&](Dice& dice) { return draw(dice, true); }), significance(2));
}

// Half of the directions towards the sky lead through windows: two that face the viewer, one in line with it.
TEST(Density, SkyThroughPortals) {
  const Scene scene = lit_scene();
  const LightTable table = make_lights(scene);
  LightSampler kernel = reader_of(scene, table);
  const Portal portals[] = {{vec3(-1, -1, -2), vec3(1.5f, 0, 0.5f), vec3(0, 1, 0)},
                            {vec3(2, 0, -1), vec3(0, 0, 2), vec3(0.3f, 0.8f, 0)},
                            {vec3(0, 1, 0), vec3(0, 1, 0), vec3(0, 0, 1)}};
  kernel.portals = portals;
  kernel.portal_count = 3;
  const auto draw = [&](Dice& dice) {
    const vec2 pick = dice.pair();
    const LightSample light = kernel.sample_light(kHere, pick, dice.pair(), dice.pair());
    return light.valid && light.distance > 1e29f ? light.direction : vec3(0.0f);
  };
  const auto density = [&](vec3 w) { return double{kernel.environment_pdf(vec3(0.0f), w)}; };
  EXPECT_GT(density_p(32, density, draw), significance(1));
}

// Each sample has the radiance and the density of a ray in its direction.
TEST(Density, LightSamplesAgreeWithWhatRaysMeet) {
  const Scene scene = lit_scene();
  const LightTable table = make_lights(scene);
  LightSampler kernel = reader_of(scene, table);
  Dice dice(10);
  int lamps = 0;
  for (int i = 0; i < 10000; i++) {
    const vec2 pick = dice.pair();
    const LightSample light = kernel.sample_light(kHere, pick, dice.pair(), dice.pair());
    ASSERT_TRUE(light.valid);
    ASSERT_NEAR(length(light.direction), 1.0f, 1e-6f);
    if (light.distance > 1e29f) {
      EXPECT_EQ(light.radiance, kernel.environment_radiance(light.direction));
      EXPECT_EQ(light.pdf, kernel.environment_pdf(vec3(0.0f), light.direction));
    } else if (const Hit hit = meet_lamp(kernel, light.direction); hit.t > 0.0f) {
      lamps++;
      EXPECT_NEAR(light.distance, hit.t, 1e-5f);
      EXPECT_EQ(light.radiance, vec3(2.0f, 3.0f, 1.0f));
      EXPECT_NEAR(kernel.hit_light_pdf(hit, kHere, light.direction, hit.t) / light.pdf, 1.0f, 1e-4f);
    }
  }
  EXPECT_GT(lamps, 1000);
}

}  // namespace ods::random_test
