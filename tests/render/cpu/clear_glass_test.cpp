// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Light that comes through clear glass onto a floor, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ods/render/cpu/render.h"
#include "tests/support/pictures.h"

namespace ods {
namespace {

constexpr double kPiD = std::numbers::pi;
constexpr double kFloor = 0.8;   // its albedo
constexpr double kBelow = 1.0;   // the floor is this far below the camera,
constexpr double kAbove = 20.0;  // and the lowest sheet this far above it: too far for light to go to and fro

// The transmission of one surface of glass, at the cosine in air.
double let_through(double ior, double cosine) {
  const double beyond = std::sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
  const double rs = (cosine - ior * beyond) / (cosine + ior * beyond);
  const double rp = (ior * cosine - beyond) / (ior * cosine + beyond);
  return 1.0 - 0.5 * (rs * rs + rp * rp);
}

// Sheets of glass over the floor.
struct Sheets {
  int count = 1;
  double ior = 1.5;
  double tint = 1.0;
  double transmittance(double cosine) const { return std::pow(tint * let_through(ior, cosine), count); }
};

Material dull(float albedo) {
  Material material = default_material();
  material.base_color = vec4(albedo, albedo, albedo, 1.0f);
  material.ior = 1.0f;  // reflects nothing but diffuse light
  return material;
}

Material glass(double ior, double tint = 1.0) {
  Material material = default_material();
  material.base_color = vec4(vec3(static_cast<float>(tint)), 1.0f);
  material.transmission = 1.0f;
  material.roughness = 0.0f;
  material.ior = static_cast<float>(ior);
  return material;
}

void add_plane(Scene& scene, double height, double half, int material) {
  const auto y = static_cast<float>(height), s = static_cast<float>(half);
  add_rectangle(scene, vec3(-s, y, s), vec3(2 * s, 0, 0), vec3(0, 0, -2 * s), material);
}

// A black ground around a floor: nothing but the floor sends light back up.
Scene floor_below(const Sheets& sheets, double half = 400.0) {
  Scene scene;
  add_plane(scene, -kBelow, 300.0, add_material(scene, dull(static_cast<float>(kFloor))));
  const int material = add_material(scene, glass(sheets.ior, sheets.tint));
  for (int i = 0; i < sheets.count; i++) add_plane(scene, kAbove + 0.01 * i, half, material);
  return scene;
}

PunctualLight sun_from(vec3 direction, float irradiance = 1.0f) {
  PunctualLight sun;
  sun.kind = kLightDirectional;
  sun.direction = direction;
  sun.intensity = vec3(irradiance);
  return sun;
}

// Light that meets the floor once.
RenderOptions floor_render(int samples) {
  RenderOptions options = small_render(16, samples);
  options.bounces = 1;
  return options;
}

// Compares the lower rows with the radiance of the floor as a function of the place on it.
void expect_floor(const Scene& scene, const RenderOptions& options, const std::function<double(glm::dvec3)>& radiance,
                  double tolerance, const std::string& what) {
  const Picture picture = render_cpu(scene, StereoCamera{}, options);
  const int width = options.width, height = width / 2;
  for (const EyeImage& eye : picture.eyes) {
    for (int y = height - 2; y < height; y++) {
      double row = 0.0, expected = 0.0;
      for (int x = 0; x < width; x++) {
        row += double{eye.radiance.at(x, y)[0]} / width;
        expected += pixel_mean(width, x, y, [&](glm::dvec3 d) { return radiance(d * (-kBelow / d.y)); }) / width;
      }
      EXPECT_NEAR(row / expected, 1.0, tolerance) << what << " row " << y << " eye " << eye.eye << ": " << row;
    }
  }
}

const Sheets kSheets[] = {{0}, {1, 1.0}, {1, 1.5}, {2, 1.5, 0.7}, {6, 1.45}};

std::string name_of(const Sheets& sheets) {
  return std::to_string(sheets.count) + " of index " + std::to_string(sheets.ior);
}

TEST(ClearGlass, SunThroughSheets) {
  for (const Sheets& sheets : kSheets) {
    Scene scene = floor_below(sheets);
    const double cosine = 0.6;
    scene.lights.push_back(sun_from(vec3(0.8f, -0.6f, 0.0f), 3.0f));
    const double expected = kFloor / kPiD * 3.0 * cosine * sheets.transmittance(cosine);
    expect_floor(
        scene, floor_render(4), [&](glm::dvec3) { return expected; }, 1e-4, name_of(sheets));
  }
}

// Both eyes share the light that one path finds.
TEST(ClearGlass, BothEyesGetTheSameSun) {
  const Sheets sheets{2, 1.5, 0.7};
  Scene scene = floor_below(sheets);
  scene.lights.push_back(sun_from(vec3(0.0f, -1.0f, 0.0f)));
  RenderOptions options = floor_render(64);
  options.eyes = Eyes::kBothEyes;
  const double expected = kFloor / kPiD * sheets.transmittance(1.0);
  expect_floor(
      scene, options, [&](glm::dvec3) { return expected; }, 2e-2, "both eyes");
}

TEST(ClearGlass, PointThroughSheets) {
  for (const Sheets& sheets : kSheets) {
    Scene scene = floor_below(sheets);
    PunctualLight lamp;
    lamp.position = vec3(10.0f, 25.0f, 0.0f);
    lamp.intensity = vec3(100.0f);
    scene.lights.push_back(lamp);
    const auto radiance = [&](glm::dvec3 place) {
      const glm::dvec3 to_light = glm::dvec3(10.0, 25.0, 0.0) - place;
      const double distance = length(to_light), cosine = to_light.y / distance;
      return kFloor / kPiD * 100.0 * cosine / (distance * distance) * sheets.transmittance(cosine);
    };
    expect_floor(scene, floor_render(16), radiance, 1e-2, name_of(sheets));
  }
}

// The floor's light from a square lamp that shines down, by midpoints.
double lamp_on_floor(glm::dvec3 place, double half, double height, const std::function<double(double)>& through) {
  const int n = 24;
  double sum = 0.0;
  for (int i = 0; i < n * n; i++) {
    const glm::dvec3 point(half * (2.0 * (i % n + 0.5) / n - 1.0), height, half * (2.0 * (i / n + 0.5) / n - 1.0));
    const glm::dvec3 to_light = point - place;
    const double distance = length(to_light), cosine = to_light.y / distance;
    sum += cosine * cosine / (distance * distance) * through(cosine);
  }
  return kFloor / kPiD * sum * 4.0 * half * half / (n * n);
}

// Large and near the sheets: rays towards it and rays that meet it by chance share the work.
TEST(ClearGlass, AreaLightThroughSheets) {
  for (const LightSampling sampling : {LightSampling::kBoth, LightSampling::kLightsOnly, LightSampling::kBsdfOnly}) {
    for (const Sheets& sheets : kSheets) {
      Scene scene = floor_below(sheets);
      Material glow = dull(0.0f);
      glow.emission = vec3(1.0f);
      glow.double_sided = 1;
      add_plane(scene, 25.0, 20.0, add_material(scene, glow));
      RenderOptions options = floor_render(1024);
      options.light_sampling = sampling;
      const auto radiance = [&](glm::dvec3 place) {
        return lamp_on_floor(place, 20.0, 25.0, [&](double cosine) { return sheets.transmittance(cosine); });
      };
      expect_floor(scene, options, radiance, 2e-2, name_of(sheets));
    }
  }
}

// Uniform skies are found by chance, pictures are aimed at, too.
TEST(ClearGlass, SkyThroughSheets) {
  for (const bool picture : {false, true}) {
    for (const Sheets& sheets : kSheets) {
      Scene scene = floor_below(sheets, 4000.0);
      scene.environment.radiance = vec3(1.0f);
      if (picture) scene.environment = {vec3(1.0f), 16, 8, std::vector<vec3>(128, vec3(1.0f))};
      double expected = 0.0;
      const int n = 4096;
      for (int i = 0; i < n; i++) {
        const double cosine = (i + 0.5) / n;
        expected += kFloor * 2.0 * cosine * sheets.transmittance(cosine) / n;
      }
      expect_floor(
          scene, floor_render(1024), [&](glm::dvec3) { return expected; }, 1e-2, name_of(sheets));
    }
  }
}

// An index of 1 reflects nothing: such a sheet is a filter, as is one whose alpha stops the rest of the light.
TEST(ClearGlass, AlphaSheetAgrees) {
  for (const bool alpha : {false, true}) {
    Scene scene = floor_below({0});
    Material sheet = glass(1.0, 0.5);
    if (alpha) {
      sheet = dull(0.0f);
      sheet.base_color.w = 0.5f;
      sheet.alpha_mode = kAlphaBlend;
    }
    add_plane(scene, kAbove, 400.0, add_material(scene, sheet));
    scene.lights.push_back(sun_from(vec3(0.8f, -0.6f, 0.0f)));
    const double expected = kFloor / kPiD * 0.6 * 0.5;
    expect_floor(
        scene, floor_render(4096), [&](glm::dvec3) { return expected; }, 1e-2, alpha ? "alpha" : "glass");
  }
}

// Behind a rough sheet no light is lost, either: paths find it there.
TEST(ClearGlass, RoughSheetKeepsTheEnergy) {
  Scene scene;
  add_plane(scene, -kBelow, 300.0, add_material(scene, dull(static_cast<float>(kFloor))));
  Material frosted = glass(1.0);
  frosted.roughness = 0.5f;
  add_plane(scene, 1.0, 4000.0, add_material(scene, frosted));
  scene.lights.push_back(sun_from(vec3(0.0f, -1.0f, 0.0f)));
  RenderOptions options = floor_render(8192);
  options.bounces = 2;
  expect_floor(
      scene, options, [&](glm::dvec3) { return kFloor / kPiD; }, 0.05, "rough");
}

// A slab that light passes unbent: less by what both faces reflect and by what it absorbs, and counted once.
TEST(ClearGlass, StraightThroughASolid) {
  const double thick = 0.5, absorption = 0.8, ior = 1.5;
  const auto through = [&](double cosine) {
    return std::pow(let_through(ior, cosine), 2) * std::exp(-absorption * thick / cosine);
  };
  Material solid = glass(ior);
  solid.thickness = 1.0f;
  solid.attenuation_distance = 1.0f;
  solid.attenuation_color = vec3(static_cast<float>(std::exp(-absorption)));
  for (const bool area : {false, true}) {
    Scene scene = floor_below({0});
    add_box(scene, vec3(-400, 20, -400), vec3(400, 20 + thick, 400), add_material(scene, solid));
    RenderOptions options = floor_render(1024);
    options.caustics = Caustics::kStraight;
    if (area) {
      Material glow = dull(0.0f);
      glow.emission = vec3(1.0f);
      add_plane(scene, 25.0, 20.0, add_material(scene, glow));
      scene.materials.back().double_sided = 1;
    } else {
      scene.lights.push_back(sun_from(vec3(0.8f, -0.6f, 0.0f)));
    }
    const auto radiance = [&](glm::dvec3 place) {
      return area ? lamp_on_floor(place, 20.0, 25.0, through) : kFloor / kPiD * 0.6 * through(0.6);
    };
    expect_floor(scene, options, radiance, 2e-2, area ? "area" : "sun");
  }
}

// The bottom of a pool: the light's way through the water begins in it.
TEST(ClearGlass, StraightOutOfASolid) {
  Scene scene = floor_below({0});
  Material water = glass(1.33);
  water.thickness = 1.0f;
  water.attenuation_distance = 1.0f;
  water.attenuation_color = vec3(static_cast<float>(std::exp(-0.3)));
  // Its bottom and walls are below the floor and far away; the camera is above the water.
  add_box(scene, vec3(-350, -1.5, -350), vec3(350, -0.5, 350), add_material(scene, water));
  scene.lights.push_back(sun_from(vec3(0.0f, -1.0f, 0.0f)));
  RenderOptions options = floor_render(4096);
  options.caustics = Caustics::kStraight;
  // The floor is seen by way of a refraction that loses the same share again. Only the pixels straight below are known.
  options.bounces = 2;
  const double seen = std::pow(let_through(1.33, 1.0), 2) * std::exp(-0.3 * 0.5 * 2) * kFloor / kPiD;
  double mean = 0.0;
  const Picture below = render_cpu(scene, StereoCamera{}, options);
  for (int x = 0; x < options.width; x++) mean += double{below.eyes[0].radiance.at(x, 7)[0]} / options.width;
  EXPECT_NEAR(mean / seen, 1.0, 0.05);
}

// Denoisers get the features of the things seen through a window.
TEST(ClearGlass, LayersShowWhatIsBehind) {
  Scene scene;
  add_plane(scene, -3.0, 300.0, add_material(scene, dull(0.25f)));
  add_plane(scene, -1.0, 300.0, add_material(scene, glass(1.0)));
  scene.environment.radiance = vec3(1.0f);
  const Picture picture = render_cpu(scene, StereoCamera{}, floor_render(16));
  EXPECT_NEAR(picture.eyes[0].depth.at(8, 7)[0], 3.0 / std::sin(kPiD / 2 * 3.5 / 4), 0.1);
  EXPECT_NEAR(picture.eyes[0].albedo.at(8, 7)[0], 0.25, 1e-3);
}

}  // namespace
}  // namespace ods
