// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The value that a material reads through a slot, compared with double precision on an infinite plane of texels.
#include "ods/kernel/texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ods/kernel/path.h"
#include "ods/render/lights.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/statistics.h"

namespace ods {
namespace {

constexpr int kWidth = 5, kHeight = 3;
constexpr int kRepeat = 10497, kMirror = 33648, kClamp = 33071;  // glTF's numbers

// The texel that stands in column or row i of the plane.
int wrapped(int i, int size, int wrap) {
  if (wrap == kClamp) return std::clamp(i, 0, size - 1);
  const int period = wrap == kMirror ? 2 * size : size;
  const int place = (i % period + period) % period;
  return place < size ? place : period - 1 - place;
}

double texel(int x, int y, int wrap_u, int wrap_v) {
  return (7 * wrapped(x, kWidth, wrap_u) + 50 * wrapped(y, kHeight, wrap_v)) / 255.0;
}

double plane_at(glm::dvec2 uv, int wrap_u, int wrap_v, bool nearest) {
  const double x = uv.x * kWidth, y = uv.y * kHeight;
  if (nearest) return texel(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)), wrap_u, wrap_v);
  const int x0 = static_cast<int>(std::floor(x - 0.5)), y0 = static_cast<int>(std::floor(y - 0.5));
  const double fx = x - 0.5 - x0, fy = y - 0.5 - y0;
  const double top = (1 - fx) * texel(x0, y0, wrap_u, wrap_v) + fx * texel(x0 + 1, y0, wrap_u, wrap_v);
  const double bottom = (1 - fx) * texel(x0, y0 + 1, wrap_u, wrap_v) + fx * texel(x0 + 1, y0 + 1, wrap_u, wrap_v);
  return (1 - fy) * top + fy * bottom;
}

// A scene whose material 0 has a picture of texel() for its roughness, read through this sampler and transform.
Scene textured(const GltfJson& sampler, const GltfJson& transform) {
  GltfBuilder file = make_triangle();
  file.json["images"] = {{{"bufferView", file.add_view(small_png())}, {"mimeType", "image/png"}}};
  file.json["samplers"] = GltfJson::array({sampler});
  file.json["textures"] = GltfJson::parse(R"([{"source": 0, "sampler": 0}])");
  GltfJson slot = {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
  file.json["materials"] = {{{"pbrMetallicRoughness", {{"metallicRoughnessTexture", slot}}}}};
  Scene scene = file.load();
  scene.textures[0].width = kWidth;
  scene.textures[0].height = kHeight;
  scene.texels.clear();
  for (int i = 0; i < kWidth * kHeight; i++) {
    scene.texels.push_back(static_cast<uint>(7 * (i % kWidth) + 50 * (i / kWidth)) << 8);
  }
  return scene;
}

// Compares both at places between -4 and 4. `expected` is where the coordinates should end up.
template <class Expected>
void expect_plane(const Scene& scene, int wrap_u, int wrap_v, bool nearest, const Expected& expected) {
  const LightTable lights = make_lights(scene);
  PathTracer tracer;
  set_scene(tracer, scene, lights);
  Dice dice(1);
  for (int i = 0; i < 2000; i++) {
    const vec2 uv(dice.between(-4.0f, 4.0f), dice.between(-4.0f, 4.0f)), other(0.3f);
    const glm::dvec2 moved = expected(glm::dvec2(uv));
    // Single precision may fall on the other side of a texel's edge.
    const auto to_edge = [](double x) { return std::abs(x - std::round(x)); };
    if (nearest && std::min(to_edge(moved.x * kWidth), to_edge(moved.y * kHeight)) < 1e-4) continue;
    const vec4 read = tracer.slot_at(scene.materials[0].metallic_roughness_slot, uv, other, false);
    ASSERT_NEAR(double{read.y}, plane_at(moved, wrap_u, wrap_v, nearest), 2e-5)
        << uv.x << ' ' << uv.y << ", wrap " << wrap_u << ' ' << wrap_v << (nearest ? " nearest" : " linear");
  }
}

TEST(Texture, EveryWrapAndFilter) {
  const auto unmoved = [](glm::dvec2 uv) { return uv; };
  for (const int wrap_u : {kRepeat, kMirror, kClamp}) {
    for (const int wrap_v : {kRepeat, kMirror, kClamp}) {
      for (const bool nearest : {false, true}) {
        const GltfJson sampler = {{"wrapS", wrap_u}, {"wrapT", wrap_v}, {"magFilter", nearest ? 9728 : 9729}};
        expect_plane(textured(sampler, GltfJson::object()), wrap_u, wrap_v, nearest, unmoved);
      }
    }
  }
}

// KHR_texture_transform: scaled, then turned (counter-clockwise in a picture whose v runs down), then moved.
TEST(Texture, TransformsScaleThenTurnThenMove) {
  Dice dice(2);
  for (int i = 0; i < 20; i++) {
    const glm::dvec2 offset(dice.between(-2, 2), dice.between(-2, 2)), scale(dice.between(-3, 3), dice.between(-3, 3));
    const double turn = dice.between(-7.0f, 7.0f), c = std::cos(turn), s = std::sin(turn);
    const GltfJson transform = {{"offset", {offset.x, offset.y}}, {"rotation", turn}, {"scale", {scale.x, scale.y}}};
    expect_plane(textured({{"wrapS", kMirror}}, transform), kMirror, kRepeat, false, [&](glm::dvec2 uv) {
      uv *= scale;
      return glm::dvec2(c * uv.x + s * uv.y, c * uv.y - s * uv.x) + offset;
    });
  }
}

// Beyond a million turns the place within a texel is lost, but what is read is a texel.
TEST(Texture, CoordinatesOfAnySizeStayInside) {
  for (const int wrap : {kRepeat, kMirror, kClamp}) {
    const Scene scene = textured({{"wrapS", wrap}, {"wrapT", wrap}}, GltfJson::object());
    const LightTable lights = make_lights(scene);
    PathTracer tracer;
    set_scene(tracer, scene, lights);
    for (const float far_away : {1e6f, -1e6f, 1e12f, -1e12f, 3e38f, -3e38f}) {
      const float value = tracer.texture_at(scene.textures[0], false, vec2(far_away, -far_away)).y;
      EXPECT_TRUE(value >= 0.0f && value <= 1.0f) << value;
    }
  }
}

}  // namespace
}  // namespace ods
