// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Plane layers of glass and liquid against the sum of all their inner reflections.
#include <gtest/gtest.h>

#include <cmath>

#include "ods/render/cpu/render.h"
#include "tests/support/pictures.h"

namespace ods {
namespace {

// One homogeneous layer, from the top.
struct Layer {
  double ior, thickness, absorption;  // per metre
};

// The transmission and reflection of a stack, equal both ways except for the side that light comes from.
struct Stack {
  double through, top, bottom;
};

double fresnel(double n1, double n2, double sine) {
  if (sine >= n1 || sine >= n2) return 1.0;
  const double c1 = std::sqrt(1.0 - sine * sine / (n1 * n1)), c2 = std::sqrt(1.0 - sine * sine / (n2 * n2));
  const double rs = (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2), rp = (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2);
  return 0.5 * (rs * rs + rp * rp);
}

// Puts b under a: the geometric series of the light that goes to and fro between them.
Stack join(Stack a, Stack b) {
  const double series = 1.0 / (1.0 - a.bottom * b.top);
  return {a.through * b.through * series, a.top + a.through * a.through * b.top * series,
          b.bottom + b.through * b.through * a.bottom * series};
}

// sine: of the angle in air.
Stack stack_of(const std::vector<Layer>& layers, double sine) {
  double above = 1.0;
  Stack stack{1.0, 0.0, 0.0};
  for (const Layer& layer : layers) {
    const double r = fresnel(above, layer.ior, sine);
    stack = join(stack, {1.0 - r, r, r});
    const double cosine = std::sqrt(1.0 - sine * sine / (layer.ior * layer.ior));
    stack = join(stack, {std::exp(-layer.absorption * layer.thickness / cosine), 0.0, 0.0});
    above = layer.ior;
  }
  const double r = fresnel(above, 1.0, sine);
  return join(stack, {1.0 - r, r, r});
}

// A sky of radiance 1 above the horizon and 3 below it.
Scene two_skies() {
  Scene scene;
  scene.environment = {vec3(1.0f), 2, 64, {}};
  for (int i = 0; i < 128; i++) scene.environment.texels.push_back(vec3(i < 64 ? 1.0f : 3.0f));
  return scene;
}

void add_slab(Scene& scene, float top, float bottom, float ior, float absorption, float dispersion = 0.0f) {
  Material material = default_material();
  material.transmission = 1.0f;
  material.thickness = 1.0f;
  material.roughness = 0.0f;
  material.ior = ior;
  if (absorption > 0.0f) {
    material.attenuation_distance = 0.5f;
    material.attenuation_color = vec3(std::exp(-absorption * 0.5f));
  }
  MaterialLayers layers = default_layers();
  layers.dispersion = dispersion;
  add_box(scene, vec3(-500, bottom, -500), vec3(500, top, 500),
          dispersion > 0.0f ? add_layered(scene, material, layers) : add_material(scene, material));
}

// The layers are alike in every direction around, so each row of the picture has one mean. colors: what red, green and
// blue light meet; only red if there is one.
void expect_colors(const Scene& scene, const std::vector<std::vector<Layer>>& colors, int samples, double tolerance,
                   const char* what) {
  const int width = 32;
  RenderOptions options = small_render(width, samples);
  options.bounces = 24;
  const Picture picture = render_cpu(scene, StereoCamera{}, options);
  for (size_t channel = 0; channel < colors.size(); channel++) {
    for (int y = 10; y < width / 2; y++) {
      double row = 0.0;
      for (int x = 0; x < width; x++) row += double{picture.eyes[0].radiance.at(x, y)[channel]} / width;
      const double expected = pixel_mean(width, 0, y, [&](glm::dvec3 d) {
        const Stack stack = stack_of(colors[channel], std::sqrt(d.x * d.x + d.z * d.z));
        return stack.top * 1.0 + stack.through * 3.0;
      });
      EXPECT_NEAR(row, expected, tolerance) << what << " row " << y << " channel " << channel;
    }
  }
}

void expect_layers(const Scene& scene, const std::vector<Layer>& layers, const char* what) {
  const int samples = 512;
  // A sample brings 1 or 3, so its deviation is at most 1.
  expect_colors(scene, {layers}, samples, 4.0 / std::sqrt(32 * samples), what);
}

TEST(Slab, ClearGlass) {
  Scene scene = two_skies();
  add_slab(scene, -1.0f, -1.2f, 1.5f, 0.0f);
  expect_layers(scene, {{1.5, 0.2, 0.0}}, "clear");
}

TEST(Slab, AbsorbingGlass) {
  Scene scene = two_skies();
  add_slab(scene, -1.0f, -1.2f, 1.5f, 3.0f);
  expect_layers(scene, {{1.5, 0.2, 3.0}}, "absorbing");
}

// The wall of a glass stays glass, whether the liquid reaches a little or far into it.
TEST(Slab, LiquidModelledIntoItsGlass) {
  for (float overlap : {0.001f, 0.05f, 0.1f}) {
    Scene scene = two_skies();
    add_slab(scene, -1.0f, -1.2f, 1.6f, 2.0f);
    add_slab(scene, -1.2f + overlap, -1.5f, 1.33f, 4.0f);
    expect_layers(scene, {{1.6, 0.2, 2.0}, {1.33, 0.3, 4.0}}, "overlap");
  }
}

// The higher index inside the lower one: layers one within another.
TEST(Slab, GlassInsideWater) {
  Scene scene = two_skies();
  add_slab(scene, -1.0f, -2.0f, 1.33f, 1.0f);
  add_slab(scene, -1.3f, -1.5f, 1.6f, 2.0f);
  expect_layers(scene, {{1.33, 0.3, 1.0}, {1.6, 0.2, 2.0}, {1.33, 0.5, 1.0}}, "inside");
}

// A volume of air within glass has the lower index, and is not there.
TEST(Slab, AirInsideGlassDoesNotCount) {
  Scene scene = two_skies();
  add_slab(scene, -1.0f, -2.0f, 1.5f, 1.0f);
  add_slab(scene, -1.3f, -1.5f, 1.0f, 0.0f);
  expect_layers(scene, {{1.5, 1.0, 1.0}}, "bubble");
}

// KHR_materials_dispersion: each colour has its own index, (index - 1) * dispersion / 40 from the index of green. A
// path has one colour once it is in the glass, three times as bright, so it varies more.
TEST(Slab, GlassThatSplitsColours) {
  Scene scene = two_skies();
  add_slab(scene, -1.0f, -1.2f, 1.5f, 8.0f, 20.0f);
  expect_colors(scene, {{{1.25, 0.2, 8.0}}, {{1.5, 0.2, 8.0}}, {{1.75, 0.2, 8.0}}}, 4096, 0.015, "split");
}

// Glass that splits colours around glass that does not: the inner one's walls split them, too.
TEST(Slab, PlainGlassInsideGlassThatSplitsColours) {
  Scene scene = two_skies();
  add_slab(scene, -1.0f, -2.0f, 1.3f, 1.0f, 20.0f);
  add_slab(scene, -1.3f, -1.5f, 1.6f, 2.0f);
  std::vector<std::vector<Layer>> colors;
  for (const double index : {1.15, 1.3, 1.45}) {
    colors.push_back({{index, 0.3, 1.0}, {1.6, 0.2, 2.0}, {index, 0.5, 1.0}});
  }
  expect_colors(scene, colors, 4096, 0.02, "inside");
}

// The camera inside a volume: its first surface is an inside.
TEST(Slab, CameraUnderWater) {
  Scene scene = two_skies();
  add_slab(scene, 2.0f, -1.0f, 1.33f, 0.5f);
  const int width = 32, samples = 512;
  RenderOptions options = small_render(width, samples);
  options.bounces = 40;
  const Picture picture = render_cpu(scene, StereoCamera{}, options);
  // Straight down: the first reflection's share goes up and down for ever.
  const double r = fresnel(1.33, 1.0, 0.0), down = std::exp(-0.5), whole = std::exp(-1.5);
  const double expected = down * ((1.0 - r) * 3.0 + r * whole * ((1.0 - r) * 1.0 + r * whole * (1.0 - r) * 3.0));
  double row = 0.0;
  for (int x = 0; x < width; x++) row += double{*picture.eyes[0].radiance.at(x, 15)} / width;
  EXPECT_NEAR(row, expected, 0.02 * expected);
}

// Thin sheets: reflection at one interface, no refraction, no medium.
TEST(Slab, ThinSheet) {
  Scene scene = two_skies();
  Material sheet = default_material();
  sheet.transmission = 1.0f;
  sheet.roughness = 0.0f;
  add_rectangle(scene, vec3(-500, -1, 500), vec3(1000, 0, 0), vec3(0, 0, -1000), add_material(scene, sheet));
  RenderOptions options = small_render(32, 512);
  const Picture picture = render_cpu(scene, StereoCamera{}, options);
  for (int y = 10; y < 16; y++) {
    double row = 0.0;
    for (int x = 0; x < 32; x++) row += double{*picture.eyes[0].radiance.at(x, y)} / 32.0;
    const double expected = pixel_mean(32, 0, y, [&](glm::dvec3 d) {
      const double r = fresnel(1.0, 1.5, std::sqrt(d.x * d.x + d.z * d.z));
      return r * 1.0 + (1.0 - r) * 3.0;
    });
    EXPECT_NEAR(row, expected, 4.0 / std::sqrt(32 * 512)) << y;
  }
}

}  // namespace
}  // namespace ods
