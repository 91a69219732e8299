// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Textures in KTX2 files.
#include <gtest/gtest.h>

#include "ods/files/read_file.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/places.h"

namespace ods {
namespace {

Binary small_ktx2() {
  return read_file(source_folder() + "/tests/image/codec/etc1s.ktx2", 1 << 20);
}

constexpr size_t kTexels = 61 * 61;

// A triangle that shows the picture of texture 0.
GltfBuilder make_textured(const GltfJson& texture) {
  GltfBuilder file = make_triangle();
  file.json["textures"] = GltfJson::array({texture});
  file.json["materials"] = GltfJson::parse(R"([{"emissiveTexture": {"index": 0}}])");
  return file;
}

TEST(GltfBasis, IsDecoded) {
  GltfBuilder file = make_textured(GltfJson::parse(R"({"extensions": {"KHR_texture_basisu": {"source": 0}}})"));
  file.json["extensionsRequired"] = file.json["extensionsUsed"] = {"KHR_texture_basisu"};
  file.json["images"] = GltfJson::array({{{"bufferView", file.add_view(small_ktx2())}, {"mimeType", "image/ktx2"}}});
  const Scene scene = file.load();
  EXPECT_EQ(scene.texels.size(), kTexels);
  EXPECT_EQ(scene.textures.at(0).srgb, 1);
  EXPECT_TRUE(scene.warnings.empty());
}

// Some exporters name the picture as if every program read it.
TEST(GltfBasis, NeedsNoExtension) {
  GltfBuilder file = make_textured(GltfJson::parse(R"({"source": 0})"));
  file.json["images"] = GltfJson::array({{{"bufferView", file.add_view(small_ktx2())}}});
  const Scene scene = file.load();
  EXPECT_EQ(scene.texels.size(), kTexels);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfBasis, WhatHasLostLessIsBetter) {
  GltfBuilder file =
      make_textured(GltfJson::parse(R"({"source": 1, "extensions": {"KHR_texture_basisu": {"source": 0}}})"));
  file.json["extensionsUsed"] = {"KHR_texture_basisu"};
  file.json["images"] = {{{"bufferView", file.add_view({1, 2, 3})}}, {{"bufferView", file.add_view(small_png())}}};
  const Scene scene = file.load();
  EXPECT_EQ(scene.texels.size(), 4u);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfBasis, OthersAreAnErrorThatNamesThem) {
  Binary cube = small_ktx2();
  cube[36] = 6;  // faces
  GltfBuilder file = make_textured(GltfJson::parse(R"({"extensions": {"KHR_texture_basisu": {"source": 0}}})"));
  file.json["images"] = GltfJson::array({{{"bufferView", file.add_view(cube)}}});
  const std::string error = error_of(file.glb());
  EXPECT_NE(error.find("image 0"), std::string::npos) << error;
  EXPECT_NE(error.find("cube map"), std::string::npos) << error;
}

}  // namespace
}  // namespace ods
