// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The textures of a file's materials, and the pictures in them.
#pragma once
#include <compare>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "ods/scene/gltf/json.h"
#include "ods/scene/scene.h"

namespace ods {

struct GltfFile;

// The conversion of a picture to texels.
enum class TexelForm {
  kPlain,       // unchanged
  kNormal,      // a normal map: in kTexelNormal if the picture has more than 8 bits per channel
  kGlossiness,  // green becomes a roughness, 1 - glossiness * alpha, the others 0, for a roughness slot
};

struct TexelSource {
  size_t image = 0;  // index in the file
  TexelForm form = TexelForm::kPlain;
  float glossiness = 1.0f;

  auto operator<=>(const TexelSource&) const = default;
};

struct Texels {
  int width = 0;
  int height = 0;
  int packing = kTexelBytes;
  std::vector<uint32_t> values;  // rows from the top
};

// Decodes pictures, in parallel. Throws Error(kInput), naming the file, if they have far more texels than a file of its
// size can.
std::vector<Texels> decode_pictures(const GltfFile& file, const std::vector<TexelSource>& sources);

// Creates textures when a material first uses them, because the use determines their form.
class TextureTable {
 public:
  TextureTable(const GltfFile& file, Scene& scene) : file_(file), scene_(scene) {}

  // The texture that a member of a material or of its extensions refers to.
  TextureSlot slot(const JsonValue& parent, const char* key, bool srgb);
  TextureSlot normal_slot(const JsonValue& parent, const char* key);
  // A texture of KHR_materials_pbrSpecularGlossiness with glossiness in alpha, for a roughness slot.
  TextureSlot glossiness_slot(const JsonValue& parent, const char* key, float glossiness);

  void decode_images();

 private:
  struct Use {
    bool srgb = false;
    TexelForm form = TexelForm::kPlain;
    float glossiness = 1.0f;

    auto operator<=>(const Use&) const = default;
  };

  TextureSlot slot(const JsonValue& parent, const char* key, const Use& use);
  int image_of(const JsonValue& texture) const;
  int texture(int index, const Use& use);

  const GltfFile& file_;
  Scene& scene_;
  std::map<std::pair<int, Use>, int> made_;  // (the file's texture, its use) -> index in the Scene
  std::vector<TexelSource> sources_;         // for each of the Scene's textures
};

// KHR_texture_transform.
UvPlace uv_place(const JsonValue& transform);

}  // namespace ods
