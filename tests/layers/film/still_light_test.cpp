// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/film/still_light.h"

#include <gtest/gtest.h>

#include <random>

#include "ods/layers/build_layers.h"
#include "ods/layers/light/light_layers.h"
#include "ods/render/cpu/render.h"
#include "tests/support/scenes.h"

namespace ods::still_light_test {

constexpr float kFloor = -1.0f, kShade = 0.4f;  // metres; half of the shade's side

// A floor under a light from straight above, a wall beside it that the light only grazes, and a shade over the floor at
// each of some places: instance 2, 3, ...
Scene shaded(const std::vector<vec2>& places) {
  Scene scene;
  add_rectangle(scene, vec3(-2, kFloor, 2), vec3(4, 0, 0), vec3(0, 0, -4), add_material(scene, matte(vec3(0.6f))));
  add_rectangle(scene, vec3(-2, kFloor, -2), vec3(4, 0, 0), vec3(0, 4, 0), add_material(scene, matte(vec3(0.2f))));
  const int black = add_material(scene, matte(vec3(0.0f)));
  for (const vec2& at : places) {
    add_rectangle(scene, vec3(at.x - kShade, 1.5f, at.y + kShade), vec3(2 * kShade, 0, 0), vec3(0, 0, -2 * kShade),
                  black);
  }
  PunctualLight light;
  light.kind = kLightDirectional;
  light.direction = vec3(0, -1, 0);
  scene.lights.push_back(light);
  scene.hidden.assign(scene.instances.size(), 0);
  return scene;
}

// Shows one of the shades, or none.
void show_shade(Scene& scene, int shade) {
  for (size_t i = 2; i < scene.hidden.size(); i++) scene.hidden[i] = static_cast<int>(i) - 2 == shade ? 0 : 1;
}

LayerLight linear_light() {
  LayerLight light;
  light.bake.render.samples = 4;
  light.bake.is_denoised = false;
  light.tone = ToneCurve::kLinear;
  return light;
}

// The ratio that players apply at a point of the floor; 1 where nothing changes, -1 if no layer shows it.
float ratio_at(const LayeredScene& scene, const LightChange& change, size_t light, vec3 point) {
  for (size_t m = 0; m < scene.meshes.size(); m++) {
    const LayerMesh& mesh = scene.meshes[m];
    for (const uvec3& corners : mesh.triangles) {
      const vec3 a = mesh.positions[corners.x], b = mesh.positions[corners.y], c = mesh.positions[corners.z];
      const vec3 normal = cross(b - a, c - a), to = point - a;
      if (std::abs(dot(normalize(normal), to)) > 1e-3f || normalize(normal).y < 0.9f) continue;
      const float u = dot(cross(to, c - a), normal) / dot(normal, normal);
      const float v = dot(cross(b - a, to), normal) / dot(normal, normal);
      if (u < 0.0f || v < 0.0f || u + v > 1.0f) continue;
      if (m >= change.places.size() || !change.places[m].exists()) return 1.0f;
      const vec2 uv = (1 - u - v) * mesh.uvs[corners.x] + u * mesh.uvs[corners.y] + v * mesh.uvs[corners.z];
      const ChangePlace& place = change.places[m];
      const Image& ratios = change.ratios[light];
      const vec2 at = clamp(uv * place.scale + place.offset, place.low, place.high);
      const int x = static_cast<int>(at.x * static_cast<float>(ratios.width));
      const int y = static_cast<int>(at.y * static_cast<float>(ratios.height));
      const float code = *ratios.at(std::min(x, ratios.width - 1), std::min(y, ratios.height - 1));
      return code / (1.0f - code) * kRatioUnit;
    }
  }
  return -1.0f;
}

struct Changed {
  LayeredScene scene;
  LightChange change;
};

Changed changed(const std::vector<vec2>& places, int width, size_t most) {
  Scene scene = shaded(places);
  show_shade(scene, -1);
  LayerGeometry geometry = build_layers(scene, {vec3(0.0f), vec3(0.2f)}, 1024);
  const CoarseLayers layers = coarse_layers(geometry, width);
  const Image without = coarse_light(layers, CpuRenderer(scene), linear_light(), "");
  std::vector<std::vector<ChangedPart>> parts;
  for (int shade = 0; shade < static_cast<int>(places.size()); shade++) {
    show_shade(scene, shade);
    const CpuRenderer renderer(scene);
    parts.push_back(changed_parts(layers, without, coarse_light(layers, renderer, linear_light(), "")));
  }
  LightChange change = light_change(layers, parts, most);
  return {std::move(geometry.scene), std::move(change)};
}

// The floor is dark below each shade, and as before elsewhere. most: the share of places that may be wrong: where a
// coarse texel has parts of two surfaces, it shows one of them.
void expect_shadows(const Changed& changed, const std::vector<vec2>& places, float margin, double most = 0.0) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> any(-1.8f, 1.8f);
  ASSERT_EQ(changed.change.ratios.size(), places.size());
  int shadowed = 0, lit = 0, wrong = 0;
  for (int i = 0; i < 4000; i++) {
    const vec3 point(any(random), kFloor, any(random));
    for (size_t light = 0; light < places.size(); light++) {
      const vec2 from = abs(vec2(point.x, point.z) - places[light]);
      const float outside = std::max(from.x, from.y) - kShade;
      if (std::abs(outside) < margin) continue;
      const float ratio = ratio_at(changed.scene, changed.change, light, point);
      if (ratio < 0.0f) continue;
      (outside < 0.0f ? shadowed : lit)++;
      wrong += outside < 0.0f ? ratio > 0.25f : std::abs(ratio - 1.0f) > 0.1f;
    }
  }
  EXPECT_LE(wrong, most * (shadowed + lit));
  EXPECT_GT(shadowed, 30);
  EXPECT_GT(lit, 4000);
}

const std::vector<vec2> kPlaces = {{-0.6f, -0.8f}, {0.3f, -0.6f}, {0.8f, 0.5f}};

TEST(StillLight, HasTheShadowOfEachMoment) {
  const Changed moving = changed(kPlaces, 1024, size_t{1} << 30);
  expect_shadows(moving, kPlaces, 0.05f);
  // Only a part of the textures is kept.
  size_t kept = 0;
  for (const Image& ratios : moving.change.ratios) kept += ratios.pixels.size() / 3;
  const size_t all = moving.scene.meshes.size() * kPlaces.size() * 260 * 260;
  EXPECT_LT(kept, 2 * all / 3);
}

// Every fourth texel in each direction, and a quarter of those.
TEST(StillLight, IsCoarserWhereItMustBe) {
  expect_shadows(changed(kPlaces, 4 * kCoarseWidth, size_t{1} << 30), kPlaces, 0.3f, 0.02);
  const Changed small = changed(kPlaces, kCoarseWidth, size_t{300} << 10);
  size_t bytes = 0;
  for (const Image& ratios : small.change.ratios) bytes += texture_bytes(ratios.pixels.size() / 3);
  EXPECT_LE(bytes, size_t{330} << 10);
  expect_shadows(small, kPlaces, 0.3f, 0.02);
}

TEST(StillLight, IsNothingWhereNothingChanges) {
  Scene scene = shaded({{9.0f, 9.0f}});
  show_shade(scene, -1);
  const LayerGeometry geometry = build_layers(scene, {vec3(0.0f), vec3(0.2f)}, 1024);
  const CoarseLayers layers = coarse_layers(geometry, 1024);
  const Image without = coarse_light(layers, CpuRenderer(scene), linear_light(), "");
  show_shade(scene, 0);
  const std::vector<std::vector<ChangedPart>> parts = {
      changed_parts(layers, without, coarse_light(layers, CpuRenderer(scene), linear_light(), ""))};
  EXPECT_TRUE(light_change(layers, parts, size_t{1} << 30).ratios.empty());
}

}  // namespace ods::still_light_test
