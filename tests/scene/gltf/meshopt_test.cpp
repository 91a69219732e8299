// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A reader of a compressed buffer view sees its decoded bytes; damaged ones give one line.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "ods/scene/animation.h"
#include "ods/scene/motion.h"
#include "tests/support/compressed_gltf.h"
#include "tests/support/temporary_folder.h"

namespace ods::meshopt_test {

GltfBuilder compressed_grid(const std::string& name = "EXT_meshopt_compression") {
  GltfBuilder file = make_grid(12);
  const size_t strides[] = {12, 12, 8, 4};
  for (int i = 0; i < 4; i++) compress_meshopt(file, i, "ATTRIBUTES", strides[i], "NONE", name);
  compress_meshopt(file, 4, "TRIANGLES", 4, "NONE", name);
  return file;
}

GltfJson& extension_of(GltfBuilder& file, int view) {
  return file.json["bufferViews"][size_t(view)]["extensions"]["EXT_meshopt_compression"];
}

uvec3 rotated(uvec3 t) {
  while (t.x != std::min({t.x, t.y, t.z})) t = uvec3(t.y, t.z, t.x);
  return t;
}

void expect_same(const Scene& actual, const Scene& expected) {
  ASSERT_EQ(actual.vertices.size(), expected.vertices.size());
  ASSERT_EQ(actual.triangles.size(), expected.triangles.size());
  for (size_t i = 0; i < actual.vertices.size(); i++) {
    const Vertex &a = actual.vertices[i], &b = expected.vertices[i];
    EXPECT_EQ(a.position, b.position) << i;
    EXPECT_EQ(a.normal, b.normal) << i;
    EXPECT_EQ(a.uv0, b.uv0) << i;
    EXPECT_EQ(a.color, b.color) << i;
  }
  for (size_t i = 0; i < actual.triangles.size(); i++) {
    EXPECT_EQ(rotated(actual.triangles[i]), rotated(expected.triangles[i])) << i;  // the codec may begin elsewhere
  }
}

TEST(GltfMeshopt, GeometryOfThePlainFile) {
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    const Scene packed = compressed_grid(name).load();
    EXPECT_TRUE(packed.warnings.empty());
    expect_same(packed, make_grid(12).load());
  }
}

TEST(GltfMeshopt, IndicesInSequence) {
  for (const size_t stride : {2, 4}) {
    GltfBuilder file = make_grid(1);
    file.primitive()["mode"] = 5;
    file.primitive()["indices"] = stride == 2 ? file.add<uint16_t>({0, 2, 1, 3}, kUshort, "SCALAR")
                                              : file.add<uint32_t>({0, 2, 1, 3}, kUint, "SCALAR");
    const Scene plain = file.load();
    compress_meshopt(file, 5, "INDICES", stride);
    expect_same(file.load(), plain);
  }
}

TEST(GltfMeshopt, OctahedralNormals) {
  for (const size_t stride : {4, 8}) {
    GltfBuilder file = make_grid(6);
    const Scene plain = file.load();
    std::vector<float> normals;
    for (const Vertex& v : plain.vertices) normals.insert(normals.end(), {v.normal.x, v.normal.y, v.normal.z, 0.0f});
    Binary bytes(plain.vertices.size() * stride);
    meshopt_encodeFilterOct(bytes.data(), plain.vertices.size(), stride, stride == 4 ? 8 : 16, normals.data());
    file.json["accessors"][1] = {{"bufferView", file.add_view(bytes)},
                                 {"componentType", stride == 4 ? kByte : kShort},
                                 {"normalized", true},
                                 {"count", plain.vertices.size()},
                                 {"type", "VEC3"}};
    file.json["bufferViews"].back()["byteStride"] = stride;
    compress_meshopt(file, 5, "ATTRIBUTES", stride, "OCTAHEDRAL");
    const Scene packed = file.load();
    ASSERT_EQ(packed.vertices.size(), plain.vertices.size());
    for (size_t i = 0; i < plain.vertices.size(); i++) {
      EXPECT_LT(glm::length(packed.vertices[i].normal - plain.vertices[i].normal), stride == 4 ? 0.02f : 1e-4f);
    }
  }
}

TEST(GltfMeshopt, ExponentialPositions) {
  GltfBuilder file = make_grid(6);
  const Scene plain = file.load();
  std::vector<float> positions;
  for (const Vertex& v : plain.vertices) positions.insert(positions.end(), {v.position.x, v.position.y, v.position.z});
  Binary bytes(positions.size() * 4);
#if MESHOPTIMIZER_VERSION < 190
  meshopt_encodeFilterExp(bytes.data(), plain.vertices.size(), 12, 20, positions.data());
#else
  meshopt_encodeFilterExp(bytes.data(), plain.vertices.size(), 12, 20, positions.data(), meshopt_EncodeExpSharedVector);
#endif
  file.json["accessors"][0]["bufferView"] = file.add_view(bytes);
  compress_meshopt(file, 5, "ATTRIBUTES", 12, "EXPONENTIAL");
  const Scene packed = file.load();
  ASSERT_EQ(packed.vertices.size(), plain.vertices.size());
  for (size_t i = 0; i < plain.vertices.size(); i++) {
    EXPECT_LT(glm::length(packed.vertices[i].position - plain.vertices[i].position), 2e-5f);
  }
}

// Keyframes: times as they are, rotations filtered.
TEST(GltfMeshopt, Animations) {
  GltfBuilder file = make_triangle();
  const int times = file.add<float>({0, 1, 2}, kFloat, "SCALAR");
  const float half = std::sqrt(0.5f);
  const std::vector<float> rotations = {0, 0, 0, 1, 0, half, 0, half, half, 0, 0, half};
  Binary bytes(3 * 8);
  meshopt_encodeFilterQuat(bytes.data(), 3, 8, 16, rotations.data());
  const int output = file.add_bytes(bytes, 12, kShort, "VEC4");
  file.json["accessors"].back()["normalized"] = true;
  file.json["animations"] = {{{"samplers", {{{"input", times}, {"output", output}}}},
                              {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
  compress_meshopt(file, times, "ATTRIBUTES", 4);
  compress_meshopt(file, output, "ATTRIBUTES", 8, "QUATERNION");
  Scene scene = file.load();
  EXPECT_TRUE(scene.warnings.empty());
  play(scene.animation, "");
  set_time(scene, 1.0);
  const Instance& turned = scene.instances.at(0);  // by 90 degrees about y
  EXPECT_NEAR(turned.row0.z, 1.0f, 1e-3f);
  EXPECT_NEAR(turned.row2.x, -1.0f, 1e-3f);
}

TEST(GltfMeshopt, PicturesSparseValuesAndSkins) {
  GltfBuilder file = make_triangle();
  const int values = file.add<float>({5, 6, 7}, kFloat, "VEC3");
  const int indices = file.add<uint32_t>({1}, kUint, "SCALAR");
  file.json["accessors"][0]["sparse"] = {{"count", 1},
                                         {"indices", {{"bufferView", indices}, {"componentType", kUint}}},
                                         {"values", {{"bufferView", values}}}};
  Binary png = small_png();
  png.resize((png.size() + 3) / 4 * 4);
  const int picture = file.add_view(png);
  file.json["images"] = {{{"bufferView", picture}, {"mimeType", "image/png"}}};
  file.json["textures"] = GltfJson::parse(R"([{"source": 0}])");
  file.json["materials"] = GltfJson::parse(R"([{"emissiveTexture": {"index": 0}}])");
  for (const int view : {0, values, indices, picture}) compress_meshopt(file, view, "ATTRIBUTES", 4);
  const Scene scene = file.load();
  EXPECT_EQ(scene.vertices.at(1).position, vec3(5, 6, 7));
  EXPECT_EQ(scene.texels.size(), 4u);
}

// --- buffers without data

TEST(GltfMeshopt, FallbackBuffersAreNotRead) {
  const TemporaryFolder folder;
  GltfBuilder file = compressed_grid();
  file.json["buffers"][0]["uri"] = "a.bin";
  file.json["buffers"][1]["uri"] = "absent.bin";
  folder.write("a.bin", {file.binary.begin(), file.binary.end()});
  folder.write("a.gltf", file.json.dump());
  expect_same(load_gltf(folder.path("a.gltf")), make_grid(12).load());
  EXPECT_EQ(gltf_files(folder.path("a.gltf")), std::vector<std::string>{"a.bin"});
}

TEST(GltfMeshopt, BuffersWithoutDataNeedNoMark) {
  GltfBuilder file = compressed_grid();
  file.json["buffers"][1].erase("extensions");
  expect_same(file.load(), make_grid(12).load());
}

TEST(GltfMeshopt, PlainViewsOfBuffersWithoutData) {
  GltfBuilder file = compressed_grid();
  file.json["bufferViews"][2].erase("extensions");
  EXPECT_NE(error_of(file.glb()).find("buffer view 2 lies in buffer 1, which has no data"), std::string::npos)
      << error_of(file.glb());
}

// --- damage

TEST(GltfMeshoptDamage, Fields) {
  struct Case {
    int view;
    const char* key;
    GltfJson value;
    const char* words;
  };
  for (const auto& [view, key, value, words] : {Case{0, "byteStride", 3, "invalid"},
                                                Case{0, "byteStride", 0, "invalid"},
                                                Case{0, "byteStride", 260, "invalid"},
                                                Case{0, "mode", "STRIPS", "invalid"},
                                                Case{0, "mode", nullptr, "invalid"},
                                                Case{0, "filter", "OCTAHEDRAL", "invalid"},
                                                Case{0, "filter", "QUATERNION", "invalid"},
                                                Case{0, "filter", "WAVELET", "invalid"},
                                                Case{0, "filter", "COLOR", "filter COLOR"},
                                                Case{4, "filter", "EXPONENTIAL", "invalid"},
                                                Case{4, "byteStride", 8, "invalid"},
                                                Case{4, "count", 10, "invalid"},
                                                Case{0, "count", 1e18, "far more"},
                                                Case{0, "count", 100000000, "far more"},
                                                Case{0, "count", -1, "negative"},
                                                Case{0, "count", 5000, "damaged"},
                                                Case{0, "count", 160, "damaged"},
                                                Case{0, "count", 0, ""},
                                                Case{0, "buffer", 7, "buffer 7 does not exist"},
                                                Case{0, "buffer", 1, "no data"},
                                                Case{0, "byteOffset", 1e18, "runs past the end"},
                                                Case{0, "byteLength", 1e18, "runs past the end"},
                                                Case{0, "byteLength", 0, "damaged"},
                                                Case{0, "byteLength", 9, "damaged"}}) {
    GltfBuilder file = compressed_grid();
    extension_of(file, view)[key] = value;
    const std::string error = error_of(file.glb());
    EXPECT_NE(error, "") << key << value;
    EXPECT_NE(error.find(words), std::string::npos) << key << value << ": " << error;
  }
}

TEST(GltfMeshoptDamage, ViewsLongerThanTheirData) {
  GltfBuilder file = compressed_grid();
  file.json["bufferViews"][0]["byteLength"] = 1e9;
  EXPECT_NE(error_of(file.glb()).find("runs past the end of its compressed data"), std::string::npos);
}

// A stream that many buffer views share is decoded for each of them.
TEST(GltfMeshoptDamage, ManyViewsOfOneStream) {
  GltfBuilder file = make_triangle();
  file.add_view(Binary(4 << 20, 0));
  compress_meshopt(file, 1, "ATTRIBUTES", 256);
  const GltfJson view = file.json["bufferViews"][1];
  for (int i = 0; i < 100; i++) file.json["bufferViews"].push_back(view);
  EXPECT_NE(error_of(file.glb()).find("far more than a file of its size"), std::string::npos) << error_of(file.glb());
}

TEST(GltfMeshoptDamage, Version1) {
  GltfBuilder file = compressed_grid();
  file.binary[extension_of(file, 0)["byteOffset"].get<size_t>()] = 0xa1;
  const std::string error = error_of(file.glb());
  EXPECT_TRUE(error.find("version 1 of meshopt") != std::string::npos) << error;
}

TEST(GltfMeshoptDamage, FlippedBits) {
  const GltfBuilder whole = compressed_grid();
  std::mt19937 random(3);
  for (int round = 0; round < 500; round++) {
    GltfBuilder file = whole;
    const GltfJson& source = extension_of(file, round % 5);
    const size_t first = source["byteOffset"], size = source["byteLength"];
    for (int i = 0; i < 3; i++) file.binary[first + random() % size] ^= static_cast<unsigned char>(1u << random() % 8);
    error_of(file.glb());
  }
}

}  // namespace ods::meshopt_test
