// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// KHR_animation_pointer on what becomes MaterialLayers: every row of the tables.
#include "ods/scene/layer_factors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ods/scene/motion.h"
#include "tests/support/moving_files.h"
#include "tests/support/scene_check.h"

namespace ods {
namespace {

const std::string kExtensions = "/materials/0/extensions/";

// A triangle of solid glass with every extension, so that nothing of them is left out.
GltfBuilder with_layers() {
  GltfBuilder file = make_triangle();
  file.primitive()["material"] = 0;
  file.json["materials"] = GltfJson::parse(R"([{"extensions": {
      "KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_volume": {"thicknessFactor": 1},
      "KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatNormalTexture": {"index": 0}},
      "KHR_materials_sheen": {"sheenColorFactor": [0.5, 0.5, 0.5]},
      "KHR_materials_anisotropy": {"anisotropyStrength": 0.5},
      "KHR_materials_iridescence": {"iridescenceFactor": 0.5},
      "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.5}}}])");
  return file;
}

void add_texture(GltfBuilder& file) {
  file.json["images"] = {{{"bufferView", file.add_view(small_png())}, {"mimeType", "image/png"}}};
  file.json["textures"] = GltfJson::parse(R"([{"source": 0}])");
}

// The member of the first material's extensions that a row names.
GltfJson& member_of(GltfBuilder& file, std::string_view name) {
  return file.json["materials"][0]["extensions"][GltfJson::json_pointer("/" + std::string(name))];
}

Scene at(const GltfBuilder& file, double seconds) {
  Scene scene = file.load();
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
  EXPECT_TRUE(play(scene.animation, ""));
  set_time(scene, seconds);
  EXPECT_EQ(broken_promise(scene), "");
  return scene;
}

TEST(LayerFactors, EveryNumberMoves) {
  for (const LayerNumber& row : kLayerNumbers) {
    SCOPED_TRACE(row.name);
    const auto low = static_cast<float>(row.low), high = static_cast<float>(std::min(row.high, 1000.0));
    GltfBuilder file = with_layers();
    add_texture(file);
    const Scene still = file.load();
    animate(file, pointer(kExtensions + std::string(row.name)), {0, 1}, {low, high}, "SCALAR");
    EXPECT_EQ(file.load().material_layers.at(0).*row.member, still.material_layers.at(0).*row.member) << "at rest";
    EXPECT_FLOAT_EQ(at(file, 0.25).material_layers.at(0).*row.member, 0.75f * low + 0.25f * high);
    Scene scene = at(file, 0.0);
    EXPECT_TRUE(set_time(scene, 1.0).materials);
    EXPECT_FALSE(set_time(scene, 1.0).materials);
  }
}

TEST(LayerFactors, EveryColorMoves) {
  for (const LayerColor& row : kLayerColors) {
    SCOPED_TRACE(row.name);
    GltfBuilder file = with_layers();
    add_texture(file);
    const Scene still = file.load();
    animate(file, pointer(kExtensions + std::string(row.name)), {0, 1}, {0, 0.5f, 1, 1, 1, 0}, "VEC3");
    EXPECT_EQ(file.load().material_layers.at(0).*row.member, still.material_layers.at(0).*row.member) << "at rest";
    EXPECT_EQ(at(file, 0.5).material_layers.at(0).*row.member, vec3(0.5f, 0.75f, 0.5f));
  }
}

TEST(LayerFactors, EveryTextureMoves) {
  for (const LayerTexture& row : kLayerTextures) {
    SCOPED_TRACE(row.name);
    GltfBuilder file = with_layers();
    add_texture(file);
    member_of(file, row.name) =
        GltfJson::parse(R"({"index": 0, "extensions": {"KHR_texture_transform": {"scale": [2, 2]}}})");
    const std::string place = kExtensions + std::string(row.name) + "/extensions/KHR_texture_transform/";
    animate(file, pointer(place + "offset"), {0, 1}, {0, 0, 1, 2}, "VEC2");
    animate(file, pointer(place + "rotation"), {0, 1}, {0, 1}, "SCALAR");
    const TextureSlot slot = at(file, 0.5).material_layers.at(0).*row.member;
    EXPECT_NE(slot.texture, -1);
    EXPECT_EQ(slot.offset, vec2(0.5f, 1.0f));
    EXPECT_NEAR(slot.axis_u.x, 2.0 * std::cos(0.5), 1e-6) << "what is not animated stays";
    EXPECT_NEAR(slot.axis_u.y, -2.0 * std::sin(0.5), 1e-6);
  }
}

// Numbers that make no sense become the same ones, whether the file or its animation has them.
TEST(LayerFactors, ValuesAreCutAsWhenAFileIsRead) {
  for (const float value : {-7.0f, 0.3f, 1.2f, 2e4f, 1e30f}) {
    for (const LayerNumber& row : kLayerNumbers) {
      GltfBuilder still = with_layers(), moving = with_layers();
      add_texture(still), add_texture(moving);
      member_of(still, row.name) = value;
      animate(moving, pointer(kExtensions + std::string(row.name)), {0}, {value}, "SCALAR");
      EXPECT_EQ(at(moving, 0.0).material_layers.at(0).*row.member, still.load().material_layers.at(0).*row.member)
          << row.name << " " << value;
    }
    for (const LayerColor& row : kLayerColors) {
      GltfBuilder still = with_layers(), moving = with_layers();
      add_texture(still), add_texture(moving);
      member_of(still, row.name) = {value, 0.25f, 1.0f};
      animate(moving, pointer(kExtensions + std::string(row.name)), {0}, {value, 0.25f, 1.0f}, "VEC3");
      EXPECT_EQ(at(moving, 0.0).material_layers.at(0).*row.member, still.load().material_layers.at(0).*row.member)
          << row.name << " " << value;
    }
  }
}

// A layer that is not there at rest would otherwise not be read at all.
TEST(LayerFactors, ACoatMayAppear) {
  GltfBuilder file = make_triangle();
  file.primitive()["material"] = 0;
  add_texture(file);
  file.json["materials"] = GltfJson::parse(R"([{"extensions": {"KHR_materials_clearcoat": {
      "clearcoatRoughnessFactor": 0.25, "clearcoatTexture": {"index": 0}}}}])");
  EXPECT_EQ(file.load().materials[0].layers, -1);
  animate(file, pointer(kExtensions + "KHR_materials_clearcoat/clearcoatFactor"), {0, 1}, {0, 1}, "SCALAR");
  const MaterialLayers layers = at(file, 1.0).material_layers.at(0);
  EXPECT_EQ(layers.clearcoat, 1.0f);
  EXPECT_EQ(layers.clearcoat_roughness, 0.25f);
  EXPECT_EQ(layers.clearcoat_slot.texture, 0);
  EXPECT_EQ(at(file, 0.0).material_layers.at(0).clearcoat, 0.0f);
}

TEST(LayerFactors, AnExtensionThatOnlyTheAnimationNamesWorks) {
  GltfBuilder file = make_triangle();
  file.primitive()["material"] = 0;
  file.json["materials"] = GltfJson::parse("[{}]");
  animate(file, pointer(kExtensions + "KHR_materials_sheen/sheenColorFactor"), {0, 1}, {0, 0, 0, 1, 1, 1}, "VEC3");
  EXPECT_EQ(at(file, 0.5).material_layers.at(0).sheen_color, vec3(0.5f));
}

TEST(LayerFactors, AnisotropyThatAppearsHasTangents) {
  GltfBuilder file = make_triangle();
  file.primitive()["material"] = 0;
  file.primitive()["attributes"]["TEXCOORD_0"] = file.add<float>({0, 1, 1, 1, 0, 0}, kFloat, "VEC2");
  file.json["materials"] = GltfJson::parse(R"([{"extensions": {"KHR_materials_anisotropy": {}}}])");
  animate(file, pointer(kExtensions + "KHR_materials_anisotropy/anisotropyStrength"), {0, 1}, {0, 1}, "SCALAR");
  for (const Vertex& vertex : at(file, 1.0).vertices) EXPECT_EQ(vertex.tangent, vec4(1, 0, 0, 1));
}

// Unlit materials have no layers; a material that does not exist is an error; an unknown factor a warning.
TEST(LayerFactors, OddTargets) {
  const std::string coat = "/extensions/KHR_materials_clearcoat/clearcoatFactor";
  GltfBuilder file = make_triangle();
  file.json["materials"] = GltfJson::parse(R"([{"extensions": {"KHR_materials_unlit": {}}}])");
  animate(file, pointer("/materials/0" + coat), {0, 1}, {0, 1}, "SCALAR");
  EXPECT_TRUE(at(file, 1.0).material_layers.empty());
  GltfBuilder unknown = with_layers();
  add_texture(unknown);
  animate(unknown, pointer(kExtensions + "KHR_materials_clearcoat/clearcoatFlavour"), {0, 1}, {0, 1}, "SCALAR");
  EXPECT_EQ(unknown.load().warnings.size(), 1u);
  animate(file, pointer("/materials/7" + coat), {0, 1}, {0, 1}, "SCALAR");
  EXPECT_NE(error_of(file.glb()).find("material 7 does not exist"), std::string::npos) << error_of(file.glb());
}

}  // namespace
}  // namespace ods
