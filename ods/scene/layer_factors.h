// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The members of MaterialLayers that animations can change: one row per factor, and per texture with an animated
// transform. A row has its name in glTF below a material's /extensions/, and the range to which values are clamped,
// which is the same as for static values.
#pragma once
#include <iterator>
#include <string_view>

#include "ods/kernel/scene_data.h"

namespace ods {

struct LayerNumber {
  std::string_view name;
  float MaterialLayers::*member;
  double low, high;
};

inline constexpr LayerNumber kLayerNumbers[] = {
    {"KHR_materials_specular/specularFactor", &MaterialLayers::specular, 0.0, 1.0},
    {"KHR_materials_clearcoat/clearcoatFactor", &MaterialLayers::clearcoat, 0.0, 1.0},
    {"KHR_materials_clearcoat/clearcoatRoughnessFactor", &MaterialLayers::clearcoat_roughness, 0.0, 1.0},
    {"KHR_materials_clearcoat/clearcoatNormalTexture/scale", &MaterialLayers::clearcoat_normal_scale, -1e3, 1e3},
    {"KHR_materials_sheen/sheenRoughnessFactor", &MaterialLayers::sheen_roughness, 0.0, 1.0},
    {"KHR_materials_anisotropy/anisotropyStrength", &MaterialLayers::anisotropy, 0.0, 1.0},
    {"KHR_materials_anisotropy/anisotropyRotation", &MaterialLayers::anisotropy_rotation, -1e3, 1e3},
    {"KHR_materials_iridescence/iridescenceFactor", &MaterialLayers::iridescence, 0.0, 1.0},
    {"KHR_materials_iridescence/iridescenceIor", &MaterialLayers::iridescence_ior, 1.0, 100.0},
    {"KHR_materials_iridescence/iridescenceThicknessMinimum", &MaterialLayers::iridescence_thinnest, 0.0, 1e5},
    {"KHR_materials_iridescence/iridescenceThicknessMaximum", &MaterialLayers::iridescence_thickest, 0.0, 1e5},
    {"KHR_materials_dispersion/dispersion", &MaterialLayers::dispersion, 0.0, 100.0},
    {"KHR_materials_diffuse_transmission/diffuseTransmissionFactor", &MaterialLayers::diffuse_transmission, 0.0, 1.0},
};
inline constexpr int kLayerNumberCount = static_cast<int>(std::size(kLayerNumbers));

struct LayerColor {
  std::string_view name;
  vec3 MaterialLayers::*member;
  double high;  // maximum of each channel; the minimum is 0
};

inline constexpr LayerColor kLayerColors[] = {
    {"KHR_materials_specular/specularColorFactor", &MaterialLayers::specular_color, 1e9},
    {"KHR_materials_sheen/sheenColorFactor", &MaterialLayers::sheen_color, 1.0},
    {"KHR_materials_diffuse_transmission/diffuseTransmissionColorFactor", &MaterialLayers::diffuse_transmission_color,
     1.0},
};
inline constexpr int kLayerColorCount = static_cast<int>(std::size(kLayerColors));

struct LayerTexture {
  std::string_view name;
  TextureSlot MaterialLayers::*member;
};

inline constexpr LayerTexture kLayerTextures[] = {
    {"KHR_materials_specular/specularTexture", &MaterialLayers::specular_slot},
    {"KHR_materials_specular/specularColorTexture", &MaterialLayers::specular_color_slot},
    {"KHR_materials_clearcoat/clearcoatTexture", &MaterialLayers::clearcoat_slot},
    {"KHR_materials_clearcoat/clearcoatRoughnessTexture", &MaterialLayers::clearcoat_roughness_slot},
    {"KHR_materials_clearcoat/clearcoatNormalTexture", &MaterialLayers::clearcoat_normal_slot},
    {"KHR_materials_sheen/sheenColorTexture", &MaterialLayers::sheen_color_slot},
    {"KHR_materials_sheen/sheenRoughnessTexture", &MaterialLayers::sheen_roughness_slot},
    {"KHR_materials_anisotropy/anisotropyTexture", &MaterialLayers::anisotropy_slot},
    {"KHR_materials_iridescence/iridescenceTexture", &MaterialLayers::iridescence_slot},
    {"KHR_materials_iridescence/iridescenceThicknessTexture", &MaterialLayers::iridescence_thickness_slot},
    {"KHR_materials_diffuse_transmission/diffuseTransmissionTexture", &MaterialLayers::diffuse_transmission_slot},
    {"KHR_materials_diffuse_transmission/diffuseTransmissionColorTexture",
     &MaterialLayers::diffuse_transmission_color_slot},
};
inline constexpr int kLayerTextureCount = static_cast<int>(std::size(kLayerTextures));

// Every member of MaterialLayers has a row.
static_assert(sizeof(MaterialLayers) == kLayerNumberCount * sizeof(float) + kLayerColorCount * sizeof(vec3) +
                                            kLayerTextureCount * sizeof(TextureSlot));

}  // namespace ods
