// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/light/sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <thread>

#include "ods/kernel/path.h"
#include "ods/render/lights.h"

namespace ods {
namespace {

using std::numbers::pi;

// A sky as the kernel sees it.
class KernelSky {
 public:
  explicit KernelSky(const SkyOptions& options) {
    scene_.environment = make_sky(options);
    lights_ = make_lights(scene_);
    set_scene(tracer_, scene_, lights_);
  }
  // degrees
  glm::dvec3 at(double azimuth, double elevation) {
    const double a = azimuth * pi / 180.0, e = elevation * pi / 180.0;
    return tracer_.environment_radiance(vec3(std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)));
  }
  glm::dvec3 at(glm::dvec3 direction) { return tracer_.environment_radiance(vec3(direction)); }
  const std::vector<vec3>& texels() const { return scene_.environment.texels; }

 private:
  Scene scene_;
  LightTable lights_;
  PathTracer tracer_;
};

// The integral of radiance over a cap around a direction, less what the ring around that cap would bring.
glm::dvec3 disc_energy(KernelSky& sky, const SkyOptions& sun) {
  const double a = static_cast<double>(sun.azimuth) * pi / 180.0, e = static_cast<double>(sun.elevation) * pi / 180.0;
  const glm::dvec3 middle(std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e));
  const glm::dvec3 right(std::cos(a), 0.0, std::sin(a)), up = glm::cross(right, middle);
  const double reach = 1.5 * pi / 180.0;
  const auto ring = [&](double away) {
    glm::dvec3 sum(0.0);
    const int spokes = 720;
    for (int i = 0; i < spokes; i++) {
      const double around = 2.0 * pi * (i + 0.5) / spokes;
      sum += sky.at(middle * std::cos(away) + (right * std::cos(around) + up * std::sin(around)) * std::sin(away));
    }
    return sum / double{spokes};
  };
  const glm::dvec3 beside = ring(reach);
  const int rings = 600;
  glm::dvec3 sum(0.0);
  for (int i = 0; i < rings; i++) {
    const double away = reach * (i + 0.5) / rings;
    sum += (ring(away) - beside) * (2.0 * pi * std::sin(away) * reach / rings);
  }
  return sum;
}

// Downward irradiance on the ground, sun included.
glm::dvec3 floor_irradiance(KernelSky& sky) {
  const int rows = 2048, columns = 2048;
  glm::dvec3 sum(0.0);
  for (int y = 0; y < rows; y++) {
    const double elevation = 90.0 * (y + 0.5) / rows, e = elevation * pi / 180.0;
    glm::dvec3 row(0.0);
    for (int x = 0; x < columns; x++) row += sky.at(360.0 * (x + 0.5) / columns, elevation);
    sum += row * (std::sin(e) * std::cos(e) * (0.5 * pi / rows) * (2.0 * pi / columns));
  }
  return sum;
}

void expect_near(glm::dvec3 a, glm::dvec3 b, double relative) {
  for (int c = 0; c < 3; c++) EXPECT_NEAR(a[c], b[c], relative * std::abs(b[c])) << "channel " << c;
}

// Straight down, optical depths are products: scattering at sea level times the scale height, and for ozone the area
// of its triangle. Rayleigh coefficients: Bruneton and Neyret 2008. The aerosol of a clear day: 0.06.
TEST(Sky, SunInTheZenithIsTheClosedForm) {
  const glm::dvec3 air = glm::dvec3(5.802e-3, 13.558e-3, 33.1e-3) * 8.0;
  const glm::dvec3 ozone = glm::dvec3(0.650e-3, 1.881e-3, 0.085e-3) * 15.0;
  const glm::dvec3 expected = glm::exp(-(air + 0.06 + ozone)) * double{kSunAboveAir};
  expect_near(sun_irradiance(90.0f), expected, 1e-3);
}

// The texels' disc, as the kernel interpolates it, brings the sun's energy, wherever in a texel and a row it stands.
TEST(Sky, DiscBringsTheSunsEnergy) {
  for (const SkyOptions& sun : {SkyOptions{90.0f, 0.0f}, SkyOptions{89.8f, 10.0f}, SkyOptions{60.0f, 33.3f},
                                SkyOptions{35.0f, 120.0f}, SkyOptions{3.0f, -179.9f}}) {
    KernelSky sky(sun);
    SCOPED_TRACE(sun.elevation);
    expect_near(disc_energy(sky, sun), glm::dvec3(sun_irradiance(sun.elevation)), 0.01);
  }
}

TEST(Sky, StandsWhereItIsAskedTo) {
  KernelSky sky({20.0f, 90.0f});
  EXPECT_GT(sky.at(90.0, 20.0).g, 1000.0);
  EXPECT_LT(sky.at(-90.0, 20.0).g, 10.0);
  EXPECT_LT(sky.at(90.0, 22.0).g, 100.0);
}

TEST(Sky, IsSymmetricAboutTheSunsMeridian) {
  KernelSky sky({35.0f, 0.0f});
  const size_t width = 1024;
  for (size_t i = 0; i < sky.texels().size(); i += 7) {
    const size_t mirrored = i / width * width + (width - 1 - i % width);
    const vec3 a = sky.texels()[i], b = sky.texels()[mirrored];
    ASSERT_NEAR(a.g, b.g, 1e-4f * a.g + 1e-7f) << i;
  }
}

TEST(Sky, ALowSunIsRedder) {
  float before = 0.0f;
  for (const float elevation : {90.0f, 35.0f, 10.0f, 5.0f, 2.0f, 0.0f}) {
    const vec3 sun = sun_irradiance(elevation);
    EXPECT_GT(sun.r, sun.g);
    EXPECT_GT(sun.g, sun.b);
    EXPECT_GT(sun.r / sun.b, before) << elevation;
    before = sun.r / sun.b;
  }
}

TEST(Sky, IsBlueAndBrighterTowardsTheHorizon) {
  KernelSky sky({35.0f, 120.0f});
  const glm::dvec3 zenith = sky.at(0.0, 89.0), high = sky.at(-60.0, 45.0), horizon = sky.at(-60.0, 2.0);
  EXPECT_GT(zenith.b, 1.5 * zenith.g);
  EXPECT_GT(zenith.g, 1.2 * zenith.r);
  EXPECT_GT(high.b, 1.3 * high.r);
  EXPECT_GT(horizon.g, 2.0 * zenith.g);
  EXPECT_LT(horizon.b / horizon.r, zenith.b / zenith.r);
}

TEST(Sky, AWhiteFloorUnderTheDefaultSunHasARadianceOfOne) {
  KernelSky sky({});
  const glm::dvec3 whole = floor_irradiance(sky);
  EXPECT_NEAR(dot(whole, glm::dvec3(0.2126, 0.7152, 0.0722)) / pi, 1.0, 0.03);
  // The ground below is as that floor, by its albedo.
  expect_near(sky.at(0.0, -89.0), whole / pi * double{sky_ground().g}, 0.02);
}

// A clear sky has a tenth to a quarter of the light, and about half of it when the sun is low; no more arrives than
// came in.
TEST(Sky, SharesItsLightWithTheSunAsAClearSkyDoes) {
  for (const float elevation : {10.0f, 35.0f, 80.0f}) {
    KernelSky sky({elevation, 0.0f});
    const double up = std::sin(double{elevation} * pi / 180.0);
    const glm::dvec3 whole = floor_irradiance(sky), direct = glm::dvec3(sun_irradiance(elevation)) * up;
    for (int c = 0; c < 3; c++) EXPECT_LT(whole[c], double{kSunAboveAir} * up) << elevation;
    const double diffuse = 1.0 - direct.g / whole.g;
    EXPECT_GT(diffuse, elevation > 20.0f ? 0.1 : 0.4) << elevation;
    EXPECT_LT(diffuse, elevation > 20.0f ? 0.25 : 0.6) << elevation;
  }
}

TEST(Sky, IsFiniteEverywhere) {
  for (const float elevation : {0.0f, 0.2f, 90.0f}) {
    KernelSky sky({elevation, 0.0f});
    ASSERT_EQ(sky.texels().size(), 1024u * 512u);
    for (const vec3& texel : sky.texels()) {
      ASSERT_TRUE(texel.r >= 0.0f && texel.g >= 0.0f && texel.b >= 0.0f && length(texel) < 1e7f) << elevation;
    }
    EXPECT_GT(sky.at(180.0, 10.0).g, 1e-4) << elevation;
  }
}

TEST(Sky, HasTheSameBitsEveryTime) {
  Environment one, other;
  std::thread first([&] { one = make_sky({20.0f, 50.0f}); });
  std::thread second([&] { other = make_sky({20.0f, 50.0f}); });
  first.join(), second.join();
  EXPECT_EQ(std::memcmp(one.texels.data(), other.texels.data(), one.texels.size() * sizeof(vec3)), 0);
}

}  // namespace
}  // namespace ods
