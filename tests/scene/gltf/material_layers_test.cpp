// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The extensions of materials that become MaterialLayers.
#include <gtest/gtest.h>

#include "tests/support/gltf_builder.h"

namespace ods {
namespace {

GltfBuilder with_materials(const char* materials) {
  GltfBuilder file = make_triangle();
  file.primitive()["material"] = 0;
  file.json["materials"] = GltfJson::parse(materials);
  return file;
}

TEST(MaterialLayers, EveryFactor) {
  const Scene scene = with_materials(R"([{"extensions": {
      "KHR_materials_specular": {"specularFactor": 0.4, "specularColorFactor": [0.5, 1, 3]},
      "KHR_materials_clearcoat": {"clearcoatFactor": 0.9, "clearcoatRoughnessFactor": 0.2},
      "KHR_materials_sheen": {"sheenColorFactor": [0.1, 0.2, 0.3], "sheenRoughnessFactor": 0.6},
      "KHR_materials_anisotropy": {"anisotropyStrength": 0.7, "anisotropyRotation": 1.5},
      "KHR_materials_iridescence": {"iridescenceFactor": 0.8, "iridescenceIor": 1.7,
          "iridescenceThicknessMinimum": 150, "iridescenceThicknessMaximum": 900},
      "KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_volume": {"thicknessFactor": 1},
      "KHR_materials_dispersion": {"dispersion": 0.33},
      "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.25,
          "diffuseTransmissionColorFactor": [1, 0.9, 0.85]}}}])")
                          .load();
  EXPECT_TRUE(scene.warnings.empty());
  ASSERT_EQ(scene.materials[0].layers, 0);
  ASSERT_EQ(scene.material_layers.size(), 1u);
  const MaterialLayers& layers = scene.material_layers[0];
  EXPECT_EQ(layers.specular, 0.4f);
  EXPECT_EQ(layers.specular_color, vec3(0.5f, 1.0f, 3.0f));
  EXPECT_EQ(layers.clearcoat, 0.9f);
  EXPECT_EQ(layers.clearcoat_roughness, 0.2f);
  EXPECT_EQ(layers.sheen_color, vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(layers.sheen_roughness, 0.6f);
  EXPECT_EQ(layers.anisotropy, 0.7f);
  EXPECT_EQ(layers.anisotropy_rotation, 1.5f);
  EXPECT_EQ(layers.iridescence, 0.8f);
  EXPECT_EQ(layers.iridescence_ior, 1.7f);
  EXPECT_EQ(layers.iridescence_thinnest, 150.0f);
  EXPECT_EQ(layers.iridescence_thickest, 900.0f);
  EXPECT_EQ(layers.dispersion, 0.33f);
  EXPECT_EQ(layers.diffuse_transmission, 0.25f);
  EXPECT_EQ(layers.diffuse_transmission_color, vec3(1.0f, 0.9f, 0.85f));
}

// Exporters write extensions whose values change nothing: such a material stays plain, which renders faster. The last
// material is for primitives without one.
TEST(MaterialLayers, DefaultsLeaveAMaterialPlain) {
  const Scene scene = with_materials(R"([
      {"extensions": {"KHR_materials_specular": {"specularFactor": 1, "specularColorFactor": [1, 1, 1]}}},
      {"extensions": {"KHR_materials_clearcoat": {"clearcoatRoughnessFactor": 0.3}}},
      {"extensions": {"KHR_materials_sheen": {"sheenRoughnessFactor": 0.3}}},
      {"extensions": {"KHR_materials_anisotropy": {"anisotropyRotation": 1}}},
      {"extensions": {"KHR_materials_iridescence": {"iridescenceIor": 1.8}}},
      {"extensions": {"KHR_materials_dispersion": {"dispersion": 1}}},
      {"extensions": {"KHR_materials_diffuse_transmission": {"diffuseTransmissionColorFactor": [1, 0, 0]}}},
      {"extensions": {"KHR_materials_unlit": {}, "KHR_materials_clearcoat": {"clearcoatFactor": 1}}}])")
                          .load();
  ASSERT_EQ(scene.materials.size(), 9u);
  for (const Material& material : scene.materials) EXPECT_EQ(material.layers, -1);
  EXPECT_TRUE(scene.material_layers.empty());
}

TEST(MaterialLayers, BadNumbersAreCutToTheirRange) {
  const Scene scene = with_materials(R"([{"extensions": {
      "KHR_materials_specular": {"specularFactor": -3, "specularColorFactor": [-1, 1e300, 1]},
      "KHR_materials_clearcoat": {"clearcoatFactor": 7, "clearcoatRoughnessFactor": -1},
      "KHR_materials_sheen": {"sheenColorFactor": [9, 9, 9], "sheenRoughnessFactor": 1e30},
      "KHR_materials_anisotropy": {"anisotropyStrength": 2},
      "KHR_materials_iridescence": {"iridescenceFactor": 2, "iridescenceIor": 0, "iridescenceThicknessMaximum": -5},
      "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 5}}}])")
                          .load();
  const MaterialLayers& layers = scene.material_layers.at(0);
  EXPECT_EQ(layers.specular, 0.0f);
  EXPECT_EQ(layers.specular_color, vec3(0.0f, 1e9f, 1.0f));
  EXPECT_EQ(layers.clearcoat, 1.0f);
  EXPECT_EQ(layers.clearcoat_roughness, 0.0f);
  EXPECT_EQ(layers.sheen_color, vec3(1.0f));
  EXPECT_EQ(layers.sheen_roughness, 1.0f);
  EXPECT_EQ(layers.anisotropy, 1.0f);
  EXPECT_EQ(layers.iridescence_ior, 1.0f);
  EXPECT_EQ(layers.iridescence_thickest, 0.0f);
  EXPECT_EQ(layers.diffuse_transmission, 1.0f);
}

// Colours have the sRGB curve, factors have not. Each texture has its own place.
TEST(MaterialLayers, EveryTexture) {
  GltfBuilder file = with_materials(R"([{"extensions": {
      "KHR_materials_specular": {"specularTexture": {"index": 0, "texCoord": 1}, "specularColorTexture": {"index": 0}},
      "KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatTexture": {"index": 0},
          "clearcoatRoughnessTexture": {"index": 0}, "clearcoatNormalTexture": {"index": 0, "scale": 0.5}},
      "KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1], "sheenColorTexture": {"index": 0,
              "extensions": {"KHR_texture_transform": {"offset": [0.5, 0.25]}}},
          "sheenRoughnessTexture": {"index": 0}},
      "KHR_materials_anisotropy": {"anisotropyStrength": 1, "anisotropyTexture": {"index": 0}},
      "KHR_materials_iridescence": {"iridescenceFactor": 1, "iridescenceTexture": {"index": 0},
          "iridescenceThicknessTexture": {"index": 0}},
      "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 1,
          "diffuseTransmissionTexture": {"index": 0}, "diffuseTransmissionColorTexture": {"index": 0}}}}])");
  file.json["images"] = {{{"bufferView", file.add_view(small_png())}, {"mimeType", "image/png"}}};
  file.json["textures"] = GltfJson::parse(R"([{"source": 0}])");
  const Scene scene = file.load();
  const MaterialLayers& layers = scene.material_layers.at(0);
  const TextureSlot colors[] = {layers.specular_color_slot, layers.sheen_color_slot,
                                layers.diffuse_transmission_color_slot};
  const TextureSlot factors[] = {layers.specular_slot,
                                 layers.clearcoat_slot,
                                 layers.clearcoat_roughness_slot,
                                 layers.clearcoat_normal_slot,
                                 layers.sheen_roughness_slot,
                                 layers.anisotropy_slot,
                                 layers.iridescence_slot,
                                 layers.iridescence_thickness_slot,
                                 layers.diffuse_transmission_slot};
  for (const TextureSlot& slot : colors) EXPECT_EQ(scene.textures.at(static_cast<size_t>(slot.texture)).srgb, 1);
  for (const TextureSlot& slot : factors) EXPECT_EQ(scene.textures.at(static_cast<size_t>(slot.texture)).srgb, 0);
  EXPECT_EQ(layers.specular_slot.uv_set, 1);
  EXPECT_EQ(layers.clearcoat_normal_scale, 0.5f);
  EXPECT_EQ(layers.sheen_color_slot.offset, vec2(0.5f, 0.25f));
}

// Anisotropy needs tangents. Files should have them; from those that have not they are made of texture coordinates.
TEST(MaterialLayers, AnisotropyMakesTangents) {
  for (const bool anisotropic : {false, true}) {
    GltfBuilder file = with_materials(
        anisotropic ? R"([{"extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 1}}}])" : R"([{}])");
    file.primitive()["attributes"]["TEXCOORD_0"] = file.add<float>({0, 1, 1, 1, 0, 0}, kFloat, "VEC2");
    for (const Vertex& vertex : file.load().vertices) {
      EXPECT_EQ(vertex.tangent, anisotropic ? vec4(1, 0, 0, 1) : vec4(0, 0, 0, 1));
    }
  }
}

}  // namespace
}  // namespace ods
