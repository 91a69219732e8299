// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>

#include "ods/base/memory.h"
#include "ods/image/image_file.h"
#include "ods/scene/gltf/parts.h"

namespace ods {

static float clamped(double value, double low, double high, double fallback) {
  return static_cast<float>(std::isfinite(value) ? std::clamp(value, low, high) : fallback);
}

static vec3 color(const std::vector<double>& values, double high) {
  vec3 result(0.0f);
  for (size_t i = 0; i < 3 && i < values.size(); i++) result[static_cast<int>(i)] = clamped(values[i], 0.0, high, 0.0);
  return result;
}

// KHR_texture_transform.
static UvPlace uv_place(const JsonValue& transform) {
  const std::vector<double> offset = numbers(transform, "offset", {0.0, 0.0});
  const std::vector<double> scale = numbers(transform, "scale", {1.0, 1.0});
  return {{offset[0], offset[1]}, number(transform, "rotation", 0.0), {scale[0], scale[1]}};
}

namespace {

// Textures are created when a material first uses them, because the use decides on the sRGB curve.
class TextureTable {
 public:
  TextureTable(const GltfFile& file, Scene& scene) : file_(file), scene_(scene) {}

  // The texture that a member of a material or of its extensions refers to.
  TextureSlot slot(const JsonValue& parent, const char* key, bool srgb);

  void decode_images();

 private:
  static int wrap(int mode) {
    constexpr int kClampToEdge = 33071, kMirroredRepeat = 33648;
    if (mode == kClampToEdge) return kWrapClamp;
    return mode == kMirroredRepeat ? kWrapMirror : kWrapRepeat;
  }

  // The image of a texture; -1: none that can be read.
  int image_of(const JsonValue& texture) const {
    const int plain = index_in(file_, texture, "source");
    return integer(file_, extension(texture, "EXT_texture_webp"), "source", plain);
  }

  int texture(int index, bool srgb);

  const GltfFile& file_;
  Scene& scene_;
  std::map<std::pair<int, bool>, int> made_;  // (the file's texture, sRGB) -> the Scene's
  std::vector<size_t> images_;                // for each of the Scene's textures
};

}  // namespace

TextureSlot TextureTable::slot(const JsonValue& parent, const char* key, bool srgb) {
  const JsonValue& info = parent[key];
  TextureSlot slot = no_texture();
  const int index = index_in(file_, info, "index");
  if (index == -1) return slot;
  slot.texture = texture(index, srgb);
  slot.uv_set = integer(file_, info, "texCoord", 0);
  const JsonValue& transform = extension(info, "KHR_texture_transform");
  if (!transform.is_null()) {
    place_texture(slot, uv_place(transform));
    slot.uv_set = integer(file_, transform, "texCoord", slot.uv_set);
  }
  if (slot.uv_set < 0 || slot.uv_set > 1) {
    warn(scene_, "a material uses a third set of texture coordinates; using the first");
    slot.uv_set = 0;
  }
  return slot;
}

int TextureTable::texture(int index, bool srgb) {
  const auto found = made_.find({index, srgb});
  if (found != made_.end()) return found->second;
  const JsonValue& source = record(file_, file_.textures, index, "texture");
  const int image = image_of(source);
  if (image == -1 && !extension(source, kBasis).is_null()) {
    warn(scene_, fmt::format("textures in the KTX2 format ({}) are white; convert them first: {}", kBasis, kBasisCure));
    return made_[{index, srgb}] = -1;
  }
  if (image == -1) {
    warn(scene_, fmt::format("texture {} has no picture that ods can read; using white", index));
    return made_[{index, srgb}] = -1;
  }
  const size_t first_image = element(file_, file_.images, image, "image").first;
  Texture texture{};
  texture.srgb = srgb;
  const int sampler_index = index_in(file_, source, "sampler");
  if (sampler_index != -1) {
    constexpr int kNearest = 9728;
    const JsonValue& sampler = record(file_, file_.samplers, sampler_index, "sampler");
    texture.wrap_u = wrap(integer(file_, sampler, "wrapS", 0));
    texture.wrap_v = wrap(integer(file_, sampler, "wrapT", 0));
    texture.nearest = integer(file_, sampler, "magFilter", 0) == kNearest;
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
  // Limits decompression: one small picture may be large, but a hundred references to it must not multiply it.
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
    // The sum decides, whatever the order.
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

// The extension's index 0 requests a Fresnel term of 1, which this index gives: it is so large that a float does not
// resolve the 1 beside it. (The tints of KHR_materials_specular are lost with it; without them such a material would be
// a mirror.)
static constexpr float kMirrorIor = 1e8f;

static void read_extensions(const JsonValue& source, Scene& scene, TextureTable& textures, Material& material) {
  const double strength = number(extension(source, "KHR_materials_emissive_strength"), "emissiveStrength", 1.0);
  material.emission *= clamped(strength, 0.0, 1e9, 1.0);
  const JsonValue& ior = extension(source, "KHR_materials_ior");
  if (!ior.is_null()) {
    const double value = number(ior, "ior", 1.5);
    const bool tinted = !extension(source, "KHR_materials_specular").is_null();
    if (value == 0.0 && !tinted) {
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
}

static Material read_material(const JsonValue& source, Scene& scene, TextureTable& textures) {
  const JsonValue &pbr = source["pbrMetallicRoughness"], &normal = source["normalTexture"];
  Material material = default_material();
  const std::vector<double> base = numbers(pbr, "baseColorFactor", {1.0, 1.0, 1.0, 1.0});
  material.base_color = vec4(color(base, 1.0), clamped(base[3], 0.0, 1.0, 1.0));
  material.base_color_slot = textures.slot(pbr, "baseColorTexture", true);
  material.metallic = clamped(number(pbr, "metallicFactor", 1.0), 0.0, 1.0, 1.0);
  material.roughness = clamped(number(pbr, "roughnessFactor", 1.0), 0.0, 1.0, 1.0);
  material.metallic_roughness_slot = textures.slot(pbr, "metallicRoughnessTexture", false);
  material.normal_scale = clamped(number(normal, "scale", 1.0), -1e3, 1e3, 1.0);
  material.normal_slot = textures.slot(source, "normalTexture", false);
  material.emission = color(numbers(source, "emissiveFactor", {0.0, 0.0, 0.0}), 1e9);
  material.emission_slot = textures.slot(source, "emissiveTexture", true);
  const std::string& alpha = *source["alphaMode"].text;
  material.alpha_mode = alpha == "MASK" ? kAlphaMask : alpha == "BLEND" ? kAlphaBlend : kAlphaOpaque;
  material.alpha_cutoff = clamped(number(source, "alphaCutoff", 0.5), 0.0, 2.0, 0.5);
  material.double_sided = source["doubleSided"].is_true();
  read_extensions(source, scene, textures, material);
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
  return moving;
}

void read_materials(const GltfFile& file, Scene& scene) {
  check_memory(file.materials.size() * (sizeof(Material) + sizeof(std::string)), file.path + ": its list of materials",
               "use a machine with more");
  TextureTable textures(file, scene);
  for (const JsonValue* material : file.materials) {
    scene.materials.push_back(read_material(*material, scene, textures));
    scene.material_names.push_back(printable(*(*material)["name"].text));
  }
  scene.materials.push_back(read_material(kNoJson, scene, textures));
  textures.decode_images();
}

}  // namespace ods
