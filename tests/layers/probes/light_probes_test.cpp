// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/probes/light_probes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ods/base/error.h"
#include "ods/layers/probes/harmonics.h"
#include "tests/support/pictures.h"

namespace ods::light_probes_test {

constexpr double kPi = std::numbers::pi;

ProbeOptions paths(int count) {
  ProbeOptions options;
  options.paths = count;
  return options;
}

void expect_light(const LightProbe& probe, const std::array<vec3, LightProbe::kHarmonics>& wanted, float tolerance) {
  for (size_t i = 0; i < wanted.size(); i++) {
    for (int c = 0; c < 3; c++) EXPECT_NEAR(probe.radiance[i][c], wanted[i][c], tolerance) << i << " " << c;
  }
}

// A lat-long picture of light that is a linear function of the direction.
Environment linear_environment(vec3 even, vec3 along) {
  Environment environment;
  environment.radiance = vec3(1.0f);
  environment.width = 128, environment.height = 64;
  for (int y = 0; y < 64; y++) {
    for (int x = 0; x < 128; x++) {
      const vec3 d = direction_of((float(x) + 0.5f) / 128.0f * float(2 * kPi) - float(kPi),
                                  float(0.5 * kPi) - (float(y) + 0.5f) / 64.0f * float(kPi));
      environment.texels.push_back(even + vec3(dot(along, d)));
    }
  }
  return environment;
}

TEST(Harmonics, AreOrthonormal) {
  double sums[9][9] = {};
  const int n = 400;
  for (int i = 0; i < n; i++) {
    for (int j = 0; j < n; j++) {
      const double z = 2.0 * (i + 0.5) / n - 1.0, phi = 2.0 * kPi * (j + 0.5) / n, r = std::sqrt(1.0 - z * z);
      const auto values = harmonics(vec3(r * std::cos(phi), r * std::sin(phi), z));
      for (size_t a = 0; a < 9; a++) {
        for (size_t b = 0; b < 9; b++) sums[a][b] += double(values[a]) * double(values[b]) * 4.0 * kPi / (n * n);
      }
    }
  }
  for (size_t a = 0; a < 9; a++) {
    for (size_t b = 0; b < 9; b++) EXPECT_NEAR(sums[a][b], a == b ? 1.0 : 0.0, 1e-4) << a << " " << b;
  }
}

TEST(LightProbes, OfAnEvenSkyHaveItsConstantOnly) {
  Scene scene;
  scene.environment.radiance = vec3(0.5f, 1.0f, 2.0f);
  const LightProbe probe = light_at(scene, vec3(1, 2, 3));
  expect_light(probe, {scene.environment.radiance * float(2.0 * std::sqrt(kPi))}, 0.005f);
  for (const vec3& normal : {vec3(0, 1, 0), vec3(-1, 0, 0)}) {
    EXPECT_NEAR(irradiance(probe, normal).y, kPi, 0.01);
  }
}

TEST(LightProbes, OfALinearSkyHaveItsGradient) {
  Scene scene;
  const vec3 along(0.3f, -0.5f, 0.2f);
  scene.environment = linear_environment(vec3(1.0f), along);
  const float one = float(std::sqrt(4.0 * kPi / 3.0));
  expect_light(light_at(scene, vec3(0.0f)),
               {vec3(float(2.0 * std::sqrt(kPi))), vec3(one * along.y), vec3(one * along.z), vec3(one * along.x)},
               0.02f);
}

// The background is for the camera only.
TEST(LightProbes, IgnoreTheBackground) {
  Scene scene;
  scene.environment.radiance = vec3(1.0f);
  scene.background.emplace().radiance = vec3(7.0f);
  expect_light(light_at(scene, vec3(0.0f)), {vec3(float(2.0 * std::sqrt(kPi)))}, 0.005f);
}

// A sphere of radiance L and half angle t has L pi sin^2 t as its first moment.
TEST(LightProbes, HaveTheLightOfASmallLamp) {
  Scene scene;
  add_sphere(scene, vec3(2, 0, 0), 0.05f, add_material(scene, glow(vec3(100.0f))), 24);
  const double sine = 0.05 / 2.0, cosine = std::sqrt(1.0 - sine * sine);
  const LightProbe probe = light_at(scene, vec3(0.0f));
  const auto values = harmonics(vec3(1, 0, 0));
  const double even = 100.0 * 2.0 * kPi * (1.0 - cosine), first = 100.0 * kPi * sine * sine;
  EXPECT_NEAR(probe.radiance[0].x, double(values[0]) * even, 0.03 * double(values[0]) * even);
  EXPECT_NEAR(probe.radiance[3].x, double(values[3]) * first, 0.03 * double(values[3]) * first);
  EXPECT_NEAR(probe.radiance[1].x, 0.0, 1e-3);
}

PunctualLight light_of(int kind) {
  PunctualLight light;
  light.kind = kind;
  light.position = vec3(0, 3, 0);
  light.direction = vec3(0, -1, 0);
  light.intensity = vec3(9.0f, 4.5f, 0.9f);
  return light;
}

TEST(LightProbes, HaveTheLightOfPointsSpotsAndSunsThatNothingHides) {
  for (const int kind : {kLightPoint, kLightSpot, kLightDirectional}) {
    Scene scene;
    scene.lights = {light_of(kind)};
    const auto values = harmonics(vec3(0, 1, 0));
    const vec3 power = scene.lights[0].intensity * (kind == kLightDirectional ? 1.0f : 1.0f / 9.0f);
    std::array<vec3, LightProbe::kHarmonics> wanted{};
    for (size_t i = 0; i < wanted.size(); i++) wanted[i] = power * values[i];
    expect_light(light_at(scene, vec3(0.0f)), wanted, 1e-3f);
    add_rectangle(scene, vec3(-1, 1, -1), vec3(0, 0, 2), vec3(2, 0, 0), add_material(scene, matte(vec3(0.0f))));
    expect_light(light_at(scene, vec3(0.0f)), {}, 1e-6f);
  }
}

// A white floor of radiance E / pi below a sun.
TEST(LightProbes, HaveTheLightThatSurfacesReflect) {
  Scene scene;
  scene.lights = {light_of(kLightDirectional)};
  add_rectangle(scene, vec3(-500, -1, 500), vec3(1000, 0, 0), vec3(0, 0, -1000),
                add_material(scene, matte(vec3(1.0f))));
  const LightProbe probe = light_at(scene, vec3(0.0f), paths(8192));
  // Half of the directions see it, and the sun is a direction of its own.
  const double even = 0.28209479 * (9.0 + 2.0 * kPi * 9.0 / kPi);
  EXPECT_NEAR(probe.radiance[0].x, even, 0.03 * even);
  const double vertical = 0.48860251 * (9.0 - kPi * 9.0 / kPi);
  EXPECT_NEAR(probe.radiance[1].x, vertical, 0.1);
}

// A room of 6 x 3 x 6 m with a closed box in it.
Scene room() {
  Scene scene;
  const int wall = add_material(scene, matte(vec3(0.5f)));
  add_box(scene, vec3(-3, 0, -3), vec3(3, 3, 3), wall);
  add_box(scene, vec3(1, 0, -2), vec3(2, 2, -0.5f), wall);
  scene.lights = {light_of(kLightPoint)};
  scene.lights[0].position = vec3(0, 2.5f, 0);
  return scene;
}

vec3 place_of(const LightProbes& probes, int i, int j, int k) {
  return probes.origin + probes.step * vec3(i, j, k);
}

TEST(LightProbes, AreWhereTheBoxSees) {
  const Scene scene = room();
  const HeadBox box{vec3(0, 1.5f, 0), vec3(0.3f)};
  const LightProbes probes = light_probes(scene, box, paths(16));
  ASSERT_EQ(probes.probes.size(), size_t(probes.count.x * probes.count.y * probes.count.z));
  EXPECT_LE(probes.probes.size(), size_t{kMostProbes});
  EXPECT_GT(probes.probes.size(), 100u);
  int free = 0, inside = 0, behind = 0;
  for (int k = 0; k < probes.count.z; k++) {
    for (int j = 0; j < probes.count.y; j++) {
      for (int i = 0; i < probes.count.x; i++) {
        const LightProbe& probe = probes.probes[size_t(i + probes.count.x * (j + probes.count.y * k))];
        const vec3 p = place_of(probes, i, j, k);
        EXPECT_TRUE(abs(p.x) < 3.0f && p.y > 0.0f && p.y < 3.0f && abs(p.z) < 3.0f);
        const bool in_box = p.x > 1 && p.x < 2 && p.y < 2 && p.z > -2 && p.z < -0.5f;
        const bool is_behind = p.x > 2.1f && p.y < 1.4f && abs(p.z / p.x + 0.7f) < 0.1f;
        inside += in_box, behind += is_behind, free += probe.weight == 1.0f;
        if (in_box || is_behind) {
          EXPECT_EQ(probe.weight, 0.0f) << p.x << " " << p.y << " " << p.z;
          EXPECT_EQ(probe.radiance[0], vec3(0.0f));
        }
        if (p.x < 0.0f) {
          EXPECT_EQ(probe.weight, 1.0f) << p.x << " " << p.y << " " << p.z;
        }
        if (probe.weight > 0.0f) {
          EXPECT_GT(probe.radiance[0].x, 0.0f);
        }
      }
    }
  }
  EXPECT_GT(free, 100);
  EXPECT_GT(inside, 0);
  EXPECT_GT(behind, 0);
}

TEST(LightProbes, AreWithinReachUnderAnOpenSky) {
  Scene scene;
  scene.environment.radiance = vec3(1.0f);
  add_rectangle(scene, vec3(-50, 0, 50), vec3(100, 0, 0), vec3(0, 0, -100), add_material(scene, matte(vec3(0.5f))));
  const LightProbes probes = light_probes(scene, {vec3(0, 1.6f, 0), vec3(0.3f)}, paths(16));
  EXPECT_LE(probes.probes.size(), size_t{kMostProbes});
  for (const LightProbe& probe : probes.probes) EXPECT_EQ(probe.weight, 1.0f);
  const vec3 last = probes.origin + probes.step * vec3(probes.count - 1);
  EXPECT_LT(last.x, 4.0f);
  EXPECT_GT(last.x, 3.5f);
  EXPECT_NEAR(probes.origin.y, 0.15f, 0.01f);
}

TEST(LightProbes, AreRepeatableAndCancelled) {
  const Scene scene = room();
  const HeadBox box{vec3(0, 1.5f, 0), vec3(0.3f)};
  const LightProbes one = light_probes(scene, box, paths(16)), two = light_probes(scene, box, paths(16));
  for (size_t i = 0; i < one.probes.size(); i++) EXPECT_EQ(one.probes[i].radiance, two.probes[i].radiance);
  Progress progress;
  progress.cancelled = [] { return true; };
  EXPECT_THROW(light_probes(scene, box, {}, progress), Error);
}

}  // namespace ods::light_probes_test
