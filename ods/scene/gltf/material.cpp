// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>

#include "ods/image/image_file.h"
#include "ods/scene/gltf/parts.h"

namespace ods {

using tinygltf::Value;

const Value& object(const Value& parent, const char* key) {
  static const Value kEmpty{Value::Object()};
  if (!parent.Has(key)) return kEmpty;
  const Value& value = parent.Get(key);
  return value.IsObject() ? value : kEmpty;
}

double number(const Value& parent, const char* key, double fallback) {
  if (!parent.Has(key)) return fallback;
  const Value& value = parent.Get(key);
  return value.IsNumber() && std::isfinite(value.GetNumberAsDouble()) ? value.GetNumberAsDouble() : fallback;
}

int integer(const Value& parent, const char* key, int fallback) {
  const double value = number(parent, key, fallback);
  return value >= -1.0 && value <= 2147483647.0 ? static_cast<int>(value) : fallback;
}

static const Value* extension(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

static float clamped(double value, double low, double high, double fallback) {
  return static_cast<float>(std::isfinite(value) ? std::clamp(value, low, high) : fallback);
}

static vec3 color(const std::vector<double>& values, double high) {
  vec3 result(0.0f);
  for (size_t i = 0; i < 3 && i < values.size(); i++) result[static_cast<int>(i)] = clamped(values[i], 0.0, high, 0.0);
  return result;
}

static std::vector<double> numbers(const Value& parent, const char* key, const std::vector<double>& fallback) {
  if (!parent.Has(key) || parent.Get(key).ArrayLen() != fallback.size()) return fallback;
  std::vector<double> values = fallback;
  for (size_t i = 0; i < values.size(); i++) {
    const Value& value = parent.Get(key).Get(static_cast<int>(i));
    if (value.IsNumber() && std::isfinite(value.GetNumberAsDouble())) values[i] = value.GetNumberAsDouble();
  }
  return values;
}

// KHR_texture_transform.
static UvPlace uv_place(const Value& transform) {
  const std::vector<double> offset = numbers(transform, "offset", {0.0, 0.0});
  const std::vector<double> scale = numbers(transform, "scale", {1.0, 1.0});
  return {{offset[0], offset[1]}, number(transform, "rotation", 0.0), {scale[0], scale[1]}};
}

namespace {

// Textures are made where a material first asks for one: the use decides about the sRGB curve.
class TextureTable {
 public:
  TextureTable(const GltfFile& file, Scene& scene) : file_(file), model_(*file.model), scene_(scene) {}

  TextureSlot slot(int index, int uv_set, const Value* transform, bool srgb) {
    TextureSlot slot = no_texture();
    if (index == -1) return slot;
    slot.texture = texture(index, srgb);
    slot.uv_set = uv_set;
    if (transform != nullptr) apply(*transform, slot);
    if (slot.uv_set < 0 || slot.uv_set > 1) {
      warn(scene_, "a material uses a third set of texture coordinates; the first is taken");
      slot.uv_set = 0;
    }
    return slot;
  }

  template <class Info>
  TextureSlot slot(const Info& info, bool srgb) {
    return slot(info.index, info.texCoord, extension(info.extensions, "KHR_texture_transform"), srgb);
  }

  // A texture named inside an extension.
  TextureSlot slot(const Value& parent, const char* key) {
    const Value& info = object(parent, key);
    const Value& extensions = object(info, "extensions");
    const Value* transform =
        extensions.Has("KHR_texture_transform") ? &object(extensions, "KHR_texture_transform") : nullptr;
    return slot(integer(info, "index", -1), integer(info, "texCoord", 0), transform, false);
  }

  void decode_images();

 private:
  static void apply(const Value& transform, TextureSlot& slot) {
    place_texture(slot, uv_place(transform));
    slot.uv_set = integer(transform, "texCoord", slot.uv_set);
  }

  static int wrap(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return kWrapClamp;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? kWrapMirror : kWrapRepeat;
  }

  // Which image a texture shows, -1: none that can be read.
  int image_of(const tinygltf::Texture& texture) const {
    const Value* webp = extension(texture.extensions, "EXT_texture_webp");
    return webp != nullptr ? integer(*webp, "source", texture.source) : texture.source;
  }

  int texture(int index, bool srgb);

  const GltfFile& file_;
  const tinygltf::Model& model_;
  Scene& scene_;
  std::map<std::pair<int, bool>, int> made_;  // (the file's texture, sRGB) -> the Scene's
  std::vector<size_t> images_;                // of each of the Scene's textures
};

}  // namespace

int TextureTable::texture(int index, bool srgb) {
  const auto found = made_.find({index, srgb});
  if (found != made_.end()) return found->second;
  const tinygltf::Texture& source = element(file_, model_.textures, index, "texture");
  const int image = image_of(source);
  if (image == -1) {
    warn(scene_, fmt::format("texture {} has no picture that ods can read; it is left white", index));
    return made_[{index, srgb}] = -1;
  }
  const size_t first_image = element(file_, file_.images, image, "image").first;
  Texture texture{};
  texture.srgb = srgb;
  if (source.sampler != -1) {
    const tinygltf::Sampler& sampler = element(file_, model_.samplers, source.sampler, "sampler");
    texture.wrap_u = wrap(sampler.wrapS);
    texture.wrap_v = wrap(sampler.wrapT);
    texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
  }
  scene_.textures.push_back(texture);
  images_.push_back(first_image);
  return made_[{index, srgb}] = static_cast<int>(images_.size()) - 1;
}

void TextureTable::decode_images() {
  std::vector<size_t> used = images_;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<CodeImage> decoded(used.size());
  // One small picture may be much; a hundred names for it would be a hundred times that.
  constexpr size_t kSmallTexels = size_t(1) << 26, kTexelsPerByte = 1024;
  size_t allowed = kSmallTexels + kTexelsPerByte * file_.size;
  for (const size_t i : used) {
    allowed += kTexelsPerByte * std::min(external_bytes(file_, file_.images[i]), kMaxFileBytes);
  }
  std::atomic<size_t> taken = 0;
  tbb::parallel_for(size_t(0), used.size(), [&](size_t i) {
    const std::vector<unsigned char> bytes = image_bytes(file_, file_.images[used[i]]);
    const std::string name = fmt::format("{}: image {}", file_.path, used[i]);
    if (bytes.empty()) fail(file_, fmt::format("image {} is empty", used[i]));
    decoded[i] = decode_image(std::as_bytes(Bytes(bytes)), name);
    taken += decoded[i].pixels.size();
    // In whatever order they come, their sum decides.
    if (taken > allowed) fail(file_, "holds far more texels than a file of its size can; it looks damaged");
  });
  size_t total = 0;
  for (const CodeImage& image : decoded) total += image.pixels.size();
  if (total > std::numeric_limits<uint>::max())
    fail(file_, "has more than four billion texels; make its images smaller");
  scene_.texels.reserve(total);
  std::vector<uint> first_texels;
  for (CodeImage& image : decoded) {
    first_texels.push_back(static_cast<uint>(scene_.texels.size()));
    scene_.texels.insert(scene_.texels.end(), image.pixels.begin(), image.pixels.end());
    image.pixels = {};
  }
  for (size_t i = 0; i < images_.size(); i++) {
    const auto k = static_cast<size_t>(std::lower_bound(used.begin(), used.end(), images_[i]) - used.begin());
    scene_.textures[i].first_texel = first_texels[k];
    scene_.textures[i].width = decoded[k].width;
    scene_.textures[i].height = decoded[k].height;
  }
}

// The extension's index 0 asks for a Fresnel term of 1: that of an index so large that a float does not see the 1
// beside it. (With it go the tints of KHR_materials_specular, without which such a material would be a mirror by
// mistake.)
static constexpr float kMirrorIor = 1e8f;

static void read_extensions(const tinygltf::Material& source, Scene& scene, TextureTable& textures,
                            Material& material) {
  if (const Value* strength = extension(source.extensions, "KHR_materials_emissive_strength")) {
    material.emission *= clamped(number(*strength, "emissiveStrength", 1.0), 0.0, 1e9, 1.0);
  }
  if (const Value* ior = extension(source.extensions, "KHR_materials_ior")) {
    const double value = number(*ior, "ior", 1.5);
    const bool tinted = source.extensions.count("KHR_materials_specular") != 0;
    if (value == 0.0 && !tinted) {
      material.ior = kMirrorIor;
    } else if (value < 1.0) {
      warn(scene, "a material has an index of refraction below 1; 1.5 is taken");
      material.ior = 1.5f;
    } else {
      material.ior = clamped(value, 1.0, 100.0, 1.5);
    }
  }
  if (const Value* transmission = extension(source.extensions, "KHR_materials_transmission")) {
    material.transmission = clamped(number(*transmission, "transmissionFactor", 0.0), 0.0, 1.0, 0.0);
    material.transmission_slot = textures.slot(*transmission, "transmissionTexture");
  }
  if (const Value* volume = extension(source.extensions, "KHR_materials_volume")) {
    material.thickness = clamped(number(*volume, "thicknessFactor", 0.0), 0.0, kFarthest, 0.0);
    material.attenuation_distance = clamped(number(*volume, "attenuationDistance", 0.0), 0.0, kFarthest, 0.0);
    material.attenuation_color = color(numbers(*volume, "attenuationColor", {1.0, 1.0, 1.0}), 1.0);
  }
  material.unlit = source.extensions.count("KHR_materials_unlit") != 0;
}

static Material read_material(const tinygltf::Material& source, Scene& scene, TextureTable& textures) {
  const auto& pbr = source.pbrMetallicRoughness;
  Material material = default_material();
  const std::vector<double>& base = pbr.baseColorFactor;
  material.base_color = vec4(color(base, 1.0), base.size() > 3 ? clamped(base[3], 0.0, 1.0, 1.0) : 1.0f);
  material.base_color_slot = textures.slot(pbr.baseColorTexture, true);
  material.metallic = clamped(pbr.metallicFactor, 0.0, 1.0, 1.0);
  material.roughness = clamped(pbr.roughnessFactor, 0.0, 1.0, 1.0);
  material.metallic_roughness_slot = textures.slot(pbr.metallicRoughnessTexture, false);
  material.normal_scale = clamped(source.normalTexture.scale, -1e3, 1e3, 1.0);
  material.normal_slot = textures.slot(source.normalTexture, false);
  material.emission = color(source.emissiveFactor, 1e9);
  material.emission_slot = textures.slot(source.emissiveTexture, true);
  material.alpha_mode = source.alphaMode == "MASK"    ? kAlphaMask
                        : source.alphaMode == "BLEND" ? kAlphaBlend
                                                      : kAlphaOpaque;
  material.alpha_cutoff = clamped(source.alphaCutoff, 0.0, 2.0, 0.5);
  material.double_sided = source.doubleSided;
  read_extensions(source, scene, textures, material);
  return material;
}

template <class Info>
static UvPlace place_of(const Info& info) {
  const Value* transform = extension(info.extensions, "KHR_texture_transform");
  return transform == nullptr ? UvPlace() : uv_place(*transform);
}

MovingMaterial read_moving_material(const GltfFile& file, const Scene& scene, int index) {
  const tinygltf::Material& source = element(file, file.model->materials, index, "material");
  const Material& material = scene.materials[static_cast<size_t>(index)];
  MovingMaterial moving;
  moving.material = index;
  moving.base_color = glm::dvec4(material.base_color);
  moving.emission = glm::dvec3(color(source.emissiveFactor, 1e9));
  if (const Value* strength = extension(source.extensions, "KHR_materials_emissive_strength")) {
    moving.strength = number(*strength, "emissiveStrength", 1.0);
  }
  moving.metallic = static_cast<double>(material.metallic);
  moving.roughness = static_cast<double>(material.roughness);
  moving.places[kBaseColorSlot] = place_of(source.pbrMetallicRoughness.baseColorTexture);
  moving.places[kMetallicRoughnessSlot] = place_of(source.pbrMetallicRoughness.metallicRoughnessTexture);
  moving.places[kNormalSlot] = place_of(source.normalTexture);
  moving.places[kEmissionSlot] = place_of(source.emissiveTexture);
  if (const Value* transmission = extension(source.extensions, "KHR_materials_transmission")) {
    const Value& extensions = object(object(*transmission, "transmissionTexture"), "extensions");
    moving.places[kTransmissionSlot] = uv_place(object(extensions, "KHR_texture_transform"));
  }
  return moving;
}

void read_materials(const GltfFile& file, Scene& scene) {
  TextureTable textures(file, scene);
  for (const tinygltf::Material& material : file.model->materials) {
    scene.materials.push_back(read_material(material, scene, textures));
    scene.material_names.push_back(printable(material.name));
  }
  scene.materials.push_back(read_material(tinygltf::Material(), scene, textures));
  textures.decode_images();
}

}  // namespace ods
