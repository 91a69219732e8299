// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/gltf/textures.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <limits>

#include "ods/image/codec/ktx2.h"
#include "ods/image/image_file.h"
#include "ods/kernel/texture.h"
#include "ods/scene/gltf/parts.h"

namespace ods {

UvPlace uv_place(const JsonValue& transform) {
  const std::vector<double> offset = numbers(transform, "offset", {0.0, 0.0});
  const std::vector<double> scale = numbers(transform, "scale", {1.0, 1.0});
  return {{offset[0], offset[1]}, number(transform, "rotation", 0.0), {scale[0], scale[1]}};
}

// --- textures

static int wrap_of(int mode) {
  constexpr int kClampToEdge = 33071, kMirroredRepeat = 33648;
  if (mode == kClampToEdge) return kWrapClamp;
  return mode == kMirroredRepeat ? kWrapMirror : kWrapRepeat;
}

// The image of a texture; -1 if none can be read. Images that are compressed for graphics cards are the last choice.
int TextureTable::image_of(const JsonValue& texture) const {
  const int plain = index_in(file_, texture, "source");
  const int compressed = index_in(file_, extension(texture, "KHR_texture_basisu"), "source");
  return integer(file_, extension(texture, "EXT_texture_webp"), "source", plain == -1 ? compressed : plain);
}

TextureSlot TextureTable::slot(const JsonValue& parent, const char* key, bool srgb) {
  return slot(parent, key, Use{srgb, TexelForm::kPlain, 1.0f});
}

TextureSlot TextureTable::normal_slot(const JsonValue& parent, const char* key) {
  return slot(parent, key, Use{false, TexelForm::kNormal, 1.0f});
}

TextureSlot TextureTable::glossiness_slot(const JsonValue& parent, const char* key, float glossiness) {
  return slot(parent, key, Use{false, TexelForm::kGlossiness, glossiness});
}

TextureSlot TextureTable::slot(const JsonValue& parent, const char* key, const Use& use) {
  const JsonValue& info = parent[key];
  TextureSlot slot = no_texture();
  const int index = index_in(file_, info, "index");
  if (index == -1) return slot;
  slot.texture = texture(index, use);
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

int TextureTable::texture(int index, const Use& use) {
  const auto found = made_.find({index, use});
  if (found != made_.end()) return found->second;
  const JsonValue& source = record(file_, file_.textures, index, "texture");
  const int image = image_of(source);
  if (image == -1) {
    warn(scene_, fmt::format("texture {} has no picture that ods can read; using white", index));
    return made_[{index, use}] = -1;
  }
  const size_t first_image = element(file_, file_.images, image, "image").first;
  Texture texture{};
  texture.srgb = use.srgb;
  const int sampler_index = index_in(file_, source, "sampler");
  if (sampler_index != -1) {
    constexpr int kNearest = 9728;
    const JsonValue& sampler = record(file_, file_.samplers, sampler_index, "sampler");
    texture.wrap_u = wrap_of(integer(file_, sampler, "wrapS", 0));
    texture.wrap_v = wrap_of(integer(file_, sampler, "wrapT", 0));
    texture.nearest = integer(file_, sampler, "magFilter", 0) == kNearest;
  }
  scene_.textures.push_back(texture);
  sources_.push_back({first_image, use.form, use.glossiness});
  return made_[{index, use}] = static_cast<int>(sources_.size()) - 1;
}

// --- pictures

static void store_glossiness(std::vector<uint32_t>& texels, float glossiness) {
  for (uint32_t& texel : texels) {
    const float roughness = 1.0f - glossiness * static_cast<float>(texel >> 24) / 255.0f;
    texel = static_cast<uint32_t>(clamp(roughness, 0.0f, 1.0f) * 255.0f + 0.5f) << 8 | 255u << 24;
  }
}

static std::vector<uint32_t> pack_normals(const std::vector<uint16_t>& codes) {
  std::vector<uint32_t> texels;
  texels.reserve(codes.size() / 3);
  for (size_t i = 0; i + 2 < codes.size(); i += 3) {
    texels.push_back(pack_normal(vec3(codes[i], codes[i + 1], codes[i + 2]) * (2.0f / 65535.0f) - vec3(1.0f)));
  }
  return texels;
}

static Texels decode_picture(const GltfFile& file, const TexelSource& source) {
  const std::vector<unsigned char> bytes = image_bytes(file, file.images[source.image]);
  if (bytes.empty()) fail(file, fmt::format("image {} is empty", source.image));
  const std::string name = fmt::format("{}: image {}", file.path, source.image);
  const std::span<const std::byte> picture = std::as_bytes(Bytes(bytes));
  CodeImage image =
      is_ktx2(picture) ? decode_ktx2(picture, name) : decode_image(picture, name, source.form == TexelForm::kNormal);
  if (!image.deep.empty()) return {image.width, image.height, kTexelNormal, pack_normals(image.deep)};
  if (source.form == TexelForm::kGlossiness) store_glossiness(image.pixels, source.glossiness);
  return {image.width, image.height, kTexelBytes, std::move(image.pixels)};
}

std::vector<Texels> decode_pictures(const GltfFile& file, const std::vector<TexelSource>& sources) {
  std::vector<Texels> decoded(sources.size());
  // Limits decompression: one small picture may be large, but a hundred references to it must not multiply it.
  constexpr size_t kSmallTexels = size_t(1) << 26, kTexelsPerByte = 1024;
  size_t allowed = kSmallTexels + kTexelsPerByte * file.size;
  for (const TexelSource& source : sources) {
    allowed += kTexelsPerByte * std::min(external_bytes(file, file.images[source.image]), kMaxFileBytes);
  }
  std::atomic<size_t> taken = 0;
  tbb::parallel_for(size_t(0), sources.size(), [&](size_t i) {
    decoded[i] = decode_picture(file, sources[i]);
    taken += decoded[i].values.size();
    // The sum decides, whatever the order.
    if (taken > allowed) fail(file, "holds far more texels than a file of its size can; it looks damaged");
  });
  return decoded;
}

void TextureTable::decode_images() {
  std::vector<TexelSource> used = sources_;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<Texels> decoded = decode_pictures(file_, used);
  size_t total = 0;
  for (const Texels& picture : decoded) total += picture.values.size();
  if (total > std::numeric_limits<uint>::max())
    fail(file_, "has more than four billion texels; make its images smaller");
  scene_.texels.reserve(total);
  std::vector<uint> first_texels;
  for (Texels& picture : decoded) {
    first_texels.push_back(static_cast<uint>(scene_.texels.size()));
    scene_.texels.insert(scene_.texels.end(), picture.values.begin(), picture.values.end());
    picture.values = {};
  }
  for (size_t i = 0; i < sources_.size(); i++) {
    const auto k = static_cast<size_t>(std::lower_bound(used.begin(), used.end(), sources_[i]) - used.begin());
    Texture& texture = scene_.textures[i];
    texture.first_texel = first_texels[k];
    texture.width = decoded[k].width;
    texture.height = decoded[k].height;
    texture.packing = decoded[k].packing;
  }
}

}  // namespace ods
