// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/gltf_builder.h"

#include <gtest/gtest.h>

#include "ods/base/error.h"
#include "tests/support/scene_check.h"

namespace ods {

int GltfBuilder::add_view(const Binary& bytes) {
  while (binary.size() % 4 != 0) binary.push_back(0);
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}});
  binary.insert(binary.end(), bytes.begin(), bytes.end());
  return static_cast<int>(json["bufferViews"].size()) - 1;
}

int GltfBuilder::add_bytes(const Binary& bytes, size_t values, int component_type, const std::string& type) {
  const size_t components = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<size_t>(type.back() - '0');
  const int view = add_view(bytes);
  json["accessors"].push_back(
      {{"bufferView", view}, {"componentType", component_type}, {"count", values / components}, {"type", type}});
  return static_cast<int>(json["accessors"].size()) - 1;
}

static void append_uint32(Binary& bytes, size_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<unsigned char>(value >> shift));
}

Binary make_glb(const std::string& text, const Binary& binary) {
  Binary bytes = {'g', 'l', 'T', 'F', 2, 0, 0, 0};
  append_uint32(bytes, 12 + 8 + text.size() + 8 + binary.size());
  append_uint32(bytes, text.size());
  append_uint32(bytes, 0x4e4f534a);
  bytes.insert(bytes.end(), text.begin(), text.end());
  append_uint32(bytes, binary.size());
  append_uint32(bytes, 0x004e4942);
  bytes.insert(bytes.end(), binary.begin(), binary.end());
  return bytes;
}

Binary GltfBuilder::glb() const {
  GltfJson document = json;
  if (!document.contains("buffers")) document["buffers"] = {{{"byteLength", binary.size()}}};
  return make_glb(document.dump(), binary);
}

Scene GltfBuilder::load(const SceneOptions& options) const {
  const Scene scene = load_gltf_bytes(glb(), "test.glb", options);
  EXPECT_EQ(broken_promise(scene), "");
  return scene;
}

GltfBuilder make_triangle() {
  GltfBuilder file;
  file.json = GltfJson::parse(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                              "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]})");
  file.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, kFloat, "VEC3");
  return file;
}

Binary small_png() {
  return {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
          0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x06, 0x00, 0x00, 0x00, 0x72,
          0xb6, 0x0d, 0x24, 0x00, 0x00, 0x00, 0x11, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0xf8,
          0xdf, 0xc0, 0xf0, 0x1f, 0x84, 0x19, 0x60, 0x0c, 0x00, 0x5a, 0xca, 0x09, 0xf9, 0xef, 0xae,
          0x6a, 0xa1, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
}

Binary flip_bits(Binary bytes, int flips, std::mt19937& random) {
  for (int i = 0; i < flips; i++) bytes[random() % bytes.size()] ^= static_cast<unsigned char>(1u << random() % 8);
  return bytes;
}

std::string error_of(const Binary& bytes) {
  try {
    const Scene scene = load_gltf_bytes(bytes, "test.glb");
    EXPECT_EQ(broken_promise(scene), "");
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    const std::string what = error.what();
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_NE(what.find("test.glb"), std::string::npos) << what;
    return what;
  }
}

}  // namespace ods
