// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Textures that ods does not decode: their fallbacks, and what to do without one.
#include <gtest/gtest.h>

#include "tests/support/gltf_builder.h"

namespace ods {
namespace {

TEST(GltfBasis, OptionalTexturesFallBack) {
  GltfBuilder file = make_triangle();
  file.json["extensionsUsed"] = {"KHR_texture_basisu"};
  file.json["images"] = {{{"bufferView", file.add_view({1, 2, 3})}}, {{"bufferView", file.add_view(small_png())}}};
  file.json["textures"] = Json::parse(R"([{"source": 1, "extensions": {"KHR_texture_basisu": {"source": 0}}}])");
  file.json["materials"] = Json::parse(R"([{"emissiveTexture": {"index": 0}}])");
  const Scene scene = file.load();
  EXPECT_EQ(scene.texels.size(), 4u);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfBasis, WithoutAFallbackTheConversionIsNamed) {
  GltfBuilder file = make_triangle();
  file.json["extensionsUsed"] = {"KHR_texture_basisu"};
  file.json["images"] = {{{"bufferView", file.add_view({1, 2, 3})}}};
  file.json["textures"] = Json::parse(R"([{"extensions": {"KHR_texture_basisu": {"source": 0}}},
                                          {"extensions": {"KHR_texture_basisu": {"source": 0}}}])");
  file.json["materials"] = Json::parse(R"([{"emissiveTexture": {"index": 0}}, {"emissiveTexture": {"index": 1}}])");
  const Scene scene = file.load();
  EXPECT_TRUE(scene.textures.empty());
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("gltf-transform ktxdecompress"), std::string::npos) << scene.warnings[0];
  file.json["extensionsRequired"] = {"KHR_texture_basisu"};
  EXPECT_NE(error_of(file.glb()).find("gltf-transform ktxdecompress"), std::string::npos) << error_of(file.glb());
}

// Some exporters name the picture as if ods could read it.
TEST(GltfBasis, PicturesNamedWithoutTheExtensionAreRecognised) {
  for (const Json& picture : {Json{{"uri", "wood.KTX2"}}, Json{{"bufferView", 1}, {"mimeType", "image/ktx2"}}}) {
    GltfBuilder file = make_triangle();
    ASSERT_EQ(file.add_view({1, 2, 3}), 1);
    file.json["images"] = {picture};
    file.json["textures"] = Json::parse(R"([{"source": 0}])");
    file.json["materials"] = Json::parse(R"([{"emissiveTexture": {"index": 0}}])");
    const Scene scene = file.load();
    EXPECT_TRUE(scene.textures.empty());
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("gltf-transform ktxdecompress"), std::string::npos) << scene.warnings[0];
    EXPECT_NE(scene.warnings[0].find("KTX-Software"), std::string::npos) << scene.warnings[0];
  }
}

}  // namespace
}  // namespace ods
