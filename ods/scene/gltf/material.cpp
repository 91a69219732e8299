// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstring>

#include "ods/base/memory.h"
#include "ods/scene/gltf/parts.h"
#include "ods/scene/gltf/textures.h"

namespace ods {

static float clamped(double value, double low, double high, double fallback) {
  return static_cast<float>(std::isfinite(value) ? std::clamp(value, low, high) : fallback);
}

static vec3 color(const std::vector<double>& values, double high) {
  vec3 result(0.0f);
  for (size_t i = 0; i < 3 && i < values.size(); i++) result[static_cast<int>(i)] = clamped(values[i], 0.0, high, 0.0);
  return result;
}

// The extension's index 0 requests a Fresnel term of 1. This index gives it, because it is too large for a float to
// resolve a difference of 1. Together with the colour of KHR_materials_specular this is the specular-glossiness model
// of other programs.
static constexpr float kMirrorIor = 1e8f;

static float factor(const JsonValue& parent, const char* key, double high, double fallback) {
  return clamped(number(parent, key, fallback), 0.0, high, fallback);
}

// moves: whether an animation changes a factor, which may be 0 at rest.
static void read_clearcoat_and_sheen(const JsonValue& source, TextureTable& textures, bool moves,
                                     MaterialLayers& layers) {
  const JsonValue& coat = extension(source, "KHR_materials_clearcoat");
  layers.clearcoat = factor(coat, "clearcoatFactor", 1.0, 0.0);
  if (moves || layers.clearcoat > 0.0f) {
    layers.clearcoat_slot = textures.slot(coat, "clearcoatTexture", false);
    layers.clearcoat_roughness = factor(coat, "clearcoatRoughnessFactor", 1.0, 0.0);
    layers.clearcoat_roughness_slot = textures.slot(coat, "clearcoatRoughnessTexture", false);
    layers.clearcoat_normal_slot = textures.normal_slot(coat, "clearcoatNormalTexture");
    layers.clearcoat_normal_scale = clamped(number(coat["clearcoatNormalTexture"], "scale", 1.0), -1e3, 1e3, 1.0);
  }
  const JsonValue& sheen = extension(source, "KHR_materials_sheen");
  layers.sheen_color = color(numbers(sheen, "sheenColorFactor", {0.0, 0.0, 0.0}), 1.0);
  if (moves || layers.sheen_color != vec3(0.0f)) {
    layers.sheen_color_slot = textures.slot(sheen, "sheenColorTexture", true);
    layers.sheen_roughness = factor(sheen, "sheenRoughnessFactor", 1.0, 0.0);
    layers.sheen_roughness_slot = textures.slot(sheen, "sheenRoughnessTexture", false);
  }
}

static void read_anisotropy_and_iridescence(const JsonValue& source, TextureTable& textures, bool moves,
                                            MaterialLayers& layers) {
  const JsonValue& anisotropy = extension(source, "KHR_materials_anisotropy");
  layers.anisotropy = factor(anisotropy, "anisotropyStrength", 1.0, 0.0);
  if (moves || layers.anisotropy > 0.0f) {
    layers.anisotropy_rotation = clamped(number(anisotropy, "anisotropyRotation", 0.0), -1e3, 1e3, 0.0);
    layers.anisotropy_slot = textures.slot(anisotropy, "anisotropyTexture", false);
  }
  const JsonValue& film = extension(source, "KHR_materials_iridescence");
  layers.iridescence = factor(film, "iridescenceFactor", 1.0, 0.0);
  if (moves || layers.iridescence > 0.0f) {
    constexpr double kThickest = 1e5;  // nanometres; interference is not visible at much smaller values
    layers.iridescence_slot = textures.slot(film, "iridescenceTexture", false);
    layers.iridescence_ior = clamped(number(film, "iridescenceIor", 1.3), 1.0, 100.0, 1.3);
    layers.iridescence_thinnest = factor(film, "iridescenceThicknessMinimum", kThickest, 100.0);
    layers.iridescence_thickest = factor(film, "iridescenceThicknessMaximum", kThickest, 400.0);
    layers.iridescence_thickness_slot = textures.slot(film, "iridescenceThicknessTexture", false);
  }
}

// Reads the layers, which few materials have. Extensions with neutral values leave the material unchanged.
static void read_layers(const JsonValue& source, Scene& scene, TextureTable& textures, bool moves, Material& material) {
  const MaterialLayers plain = default_layers();
  MaterialLayers layers = plain;
  const JsonValue& specular = extension(source, "KHR_materials_specular");
  const JsonValue& older = extension(source, "KHR_materials_pbrSpecularGlossiness");
  if (older.is_null()) {
    layers.specular = factor(specular, "specularFactor", 1.0, 1.0);
    layers.specular_slot = textures.slot(specular, "specularTexture", false);
    layers.specular_color = color(numbers(specular, "specularColorFactor", {1.0, 1.0, 1.0}), 1e9);
    layers.specular_color_slot = textures.slot(specular, "specularColorTexture", true);
  } else {
    layers.specular_color = color(numbers(older, "specularFactor", {1.0, 1.0, 1.0}), 1.0);
    layers.specular_color_slot = textures.slot(older, "specularGlossinessTexture", true);
  }
  read_clearcoat_and_sheen(source, textures, moves, layers);
  read_anisotropy_and_iridescence(source, textures, moves, layers);
  if (material.transmission > 0.0f && material.thickness > 0.0f) {
    layers.dispersion = factor(extension(source, "KHR_materials_dispersion"), "dispersion", 100.0, 0.0);
  }
  const JsonValue& through = extension(source, "KHR_materials_diffuse_transmission");
  layers.diffuse_transmission = factor(through, "diffuseTransmissionFactor", 1.0, 0.0);
  if (moves || layers.diffuse_transmission > 0.0f) {
    layers.diffuse_transmission_slot = textures.slot(through, "diffuseTransmissionTexture", false);
    layers.diffuse_transmission_color = color(numbers(through, "diffuseTransmissionColorFactor", {1.0, 1.0, 1.0}), 1.0);
    layers.diffuse_transmission_color_slot = textures.slot(through, "diffuseTransmissionColorTexture", true);
  }
  if (!moves && std::memcmp(&layers, &plain, sizeof plain) == 0) return;
  material.layers = static_cast<int>(scene.material_layers.size());
  scene.material_layers.push_back(layers);
}

static void read_extensions(const JsonValue& source, Scene& scene, TextureTable& textures, bool moves,
                            Material& material) {
  const double strength = number(extension(source, "KHR_materials_emissive_strength"), "emissiveStrength", 1.0);
  material.emission *= clamped(strength, 0.0, 1e9, 1.0);
  const JsonValue& ior = extension(source, "KHR_materials_ior");
  if (!ior.is_null()) {
    const double value = number(ior, "ior", 1.5);
    if (value == 0.0) {
      material.ior = kMirrorIor;
    } else if (value < 1.0) {
      warn(scene, "a material has an index of refraction below 1; using 1.5");
      material.ior = 1.5f;
    } else {
      material.ior = clamped(value, 1.0, 100.0, 1.5);
    }
  }
  const JsonValue& transmission = extension(source, "KHR_materials_transmission");
  if (!transmission.is_null()) {
    material.transmission = clamped(number(transmission, "transmissionFactor", 0.0), 0.0, 1.0, 0.0);
    material.transmission_slot = textures.slot(transmission, "transmissionTexture", false);
  }
  const JsonValue& volume = extension(source, "KHR_materials_volume");
  if (!volume.is_null()) {
    material.thickness = clamped(number(volume, "thicknessFactor", 0.0), 0.0, kFarthest, 0.0);
    material.attenuation_distance = clamped(number(volume, "attenuationDistance", 0.0), 0.0, kFarthest, 0.0);
    material.attenuation_color = color(numbers(volume, "attenuationColor", {1.0, 1.0, 1.0}), 1.0);
  }
  material.unlit = !extension(source, "KHR_materials_unlit").is_null();
  if (material.unlit == 0) read_layers(source, scene, textures, moves, material);
}

// KHR_materials_pbrSpecularGlossiness, which KHR_materials_specular replaced: with an index of refraction of 0, a
// dielectric reflects just its specular colour and scatters the rest. read_layers() reads that colour.
static void read_specular_glossiness(const JsonValue& older, TextureTable& textures, Material& material) {
  const std::vector<double> diffuse = numbers(older, "diffuseFactor", {1.0, 1.0, 1.0, 1.0});
  material.base_color = vec4(color(diffuse, 1.0), clamped(diffuse[3], 0.0, 1.0, 1.0));
  material.base_color_slot = textures.slot(older, "diffuseTexture", true);
  const float glossiness = factor(older, "glossinessFactor", 1.0, 1.0);
  material.metallic = 0.0f;
  material.metallic_roughness_slot = textures.glossiness_slot(older, "specularGlossinessTexture", glossiness);
  material.roughness = material.metallic_roughness_slot.texture == -1 ? 1.0f - glossiness : 1.0f;
  material.ior = kMirrorIor;
}

static Material read_material(const JsonValue& source, Scene& scene, TextureTable& textures, bool moves) {
  const JsonValue &pbr = source["pbrMetallicRoughness"], &normal = source["normalTexture"];
  Material material = default_material();
  const std::vector<double> base = numbers(pbr, "baseColorFactor", {1.0, 1.0, 1.0, 1.0});
  material.base_color = vec4(color(base, 1.0), clamped(base[3], 0.0, 1.0, 1.0));
  const float scale = factor(extension(source, "ODS_albedo"), "scale", 2.0, 1.0);
  for (int c = 0; c < 3; c++) material.base_color[c] *= scale;
  material.base_color_slot = textures.slot(pbr, "baseColorTexture", true);
  material.metallic = clamped(number(pbr, "metallicFactor", 1.0), 0.0, 1.0, 1.0);
  material.roughness = clamped(number(pbr, "roughnessFactor", 1.0), 0.0, 1.0, 1.0);
  material.metallic_roughness_slot = textures.slot(pbr, "metallicRoughnessTexture", false);
  material.normal_scale = clamped(number(normal, "scale", 1.0), -1e3, 1e3, 1.0);
  material.normal_slot = textures.normal_slot(source, "normalTexture");
  material.emission = color(numbers(source, "emissiveFactor", {0.0, 0.0, 0.0}), 1e9);
  material.emission_slot = textures.slot(source, "emissiveTexture", true);
  const std::string& alpha = *source["alphaMode"].text;
  material.alpha_mode = alpha == "MASK" ? kAlphaMask : alpha == "BLEND" ? kAlphaBlend : kAlphaOpaque;
  material.alpha_cutoff = clamped(number(source, "alphaCutoff", 0.5), 0.0, 2.0, 0.5);
  material.double_sided = source["doubleSided"].is_true();
  read_extensions(source, scene, textures, moves, material);
  const JsonValue& older = extension(source, "KHR_materials_pbrSpecularGlossiness");
  if (!older.is_null()) read_specular_glossiness(older, textures, material);
  return material;
}

static UvPlace place_of(const JsonValue& parent, const char* key) {
  const JsonValue& transform = extension(parent[key], "KHR_texture_transform");
  return transform.is_null() ? UvPlace() : uv_place(transform);
}

MovingMaterial read_moving_material(const GltfFile& file, const Scene& scene, int index) {
  const JsonValue& source = record(file, file.materials, index, "material");
  const JsonValue& pbr = source["pbrMetallicRoughness"];
  const Material& material = scene.materials[static_cast<size_t>(index)];
  MovingMaterial moving;
  moving.material = index;
  moving.base_color = glm::dvec4(material.base_color);
  moving.emission = glm::dvec3(color(numbers(source, "emissiveFactor", {0.0, 0.0, 0.0}), 1e9));
  moving.strength = number(extension(source, "KHR_materials_emissive_strength"), "emissiveStrength", moving.strength);
  moving.metallic = static_cast<double>(material.metallic);
  moving.roughness = static_cast<double>(material.roughness);
  moving.places[kBaseColorSlot] = place_of(pbr, "baseColorTexture");
  moving.places[kMetallicRoughnessSlot] = place_of(pbr, "metallicRoughnessTexture");
  moving.places[kNormalSlot] = place_of(source, "normalTexture");
  moving.places[kEmissionSlot] = place_of(source, "emissiveTexture");
  moving.places[kTransmissionSlot] = place_of(extension(source, "KHR_materials_transmission"), "transmissionTexture");
  for (size_t i = 0; i < std::size(kLayerTextures); i++) {
    const std::string name(kLayerTextures[i].name);
    const size_t slash = name.find('/');
    moving.places[kFirstLayerSlot + i] =
        place_of(extension(source, name.substr(0, slash).c_str()), name.c_str() + slash + 1);
  }
  if (material.layers >= 0) rest_at(moving, scene.material_layers[static_cast<size_t>(material.layers)]);
  return moving;
}

void read_materials(GltfFile& file, Scene& scene) {
  check_memory(file.materials.size() * (sizeof(Material) + sizeof(std::string)), file.path + ": its list of materials",
               "use a machine with more");
  TextureTable textures(file, scene);
  file.moving_layers = find_moving_layers(file);
  for (size_t i = 0; i < file.materials.size(); i++) {
    const JsonValue& material = *file.materials[i];
    scene.materials.push_back(read_material(material, scene, textures, file.moving_layers[i] != 0));
    scene.material_names.push_back(printable(*material["name"].text));
  }
  scene.materials.push_back(read_material(kNoJson, scene, textures, false));
  textures.decode_images();
}

}  // namespace ods
