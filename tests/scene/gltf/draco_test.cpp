// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Compressed primitives give the geometry of the plain file; damaged ones one line.
#include <draco/attributes/geometry_attribute.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <random>
#include <tuple>

#include "tests/support/compressed_gltf.h"

namespace ods {
namespace {

// In an order that does not depend on how vertices and triangles are numbered, or where a triangle starts.
using Corner = std::tuple<float, float, float, float, float, float, float, float>;
std::vector<std::vector<Corner>> shape_of(const Scene& scene) {
  std::vector<std::vector<Corner>> triangles;
  for (const uvec3& t : scene.triangles) {
    std::vector<Corner> corners;
    for (int c = 0; c < 3; c++) {
      const Vertex& v = scene.vertices[t[c]];
      corners.emplace_back(v.position.x, v.position.y, v.position.z, v.normal.x, v.normal.z, v.uv0.x, v.uv0.y,
                           v.color.x);
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    triangles.push_back(corners);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

void expect_same(const Scene& actual, const Scene& expected) {
  ASSERT_EQ(actual.vertices.size(), expected.vertices.size());
  EXPECT_EQ(actual.triangles, expected.triangles);
  for (size_t i = 0; i < actual.vertices.size(); i++) {
    const Vertex &a = actual.vertices[i], &b = expected.vertices[i];
    EXPECT_EQ(a.position, b.position) << i;
    EXPECT_EQ(a.normal, b.normal) << i;
    EXPECT_EQ(a.uv0, b.uv0) << i;
    EXPECT_EQ(a.color, b.color) << i;
  }
}

GltfBuilder compressed_grid(const DracoChoice& choice, bool keep = false) {
  GltfBuilder file = make_grid(12);
  compress_draco(file, file.primitive(), choice, keep);
  return file;
}

GltfJson& extension_of(GltfBuilder& file) {
  return file.primitive()["extensions"]["KHR_draco_mesh_compression"];
}

// The bytes of the stream, which is the last buffer view.
unsigned char* stream_of(GltfBuilder& file) {
  return &file.binary[file.json["bufferViews"].back()["byteOffset"].get<size_t>()];
}
size_t stream_size(const GltfBuilder& file) {
  return file.json["bufferViews"].back()["byteLength"];
}

TEST(GltfDraco, ExactStreamsGiveTheGeometryOfThePlainFile) {
  const Scene plain = make_grid(12).load(), packed = compressed_grid({}).load();
  EXPECT_EQ(plain.triangles.size(), 288u);
  EXPECT_TRUE(packed.warnings.empty());
  expect_same(packed, plain);
}

TEST(GltfDraco, ReorderedStreamsHoldTheSameTriangles) {
  const Scene packed = compressed_grid({.edgebreaker = true}).load();
  EXPECT_EQ(shape_of(packed), shape_of(make_grid(12).load()));
}

TEST(GltfDraco, QuantizedStreamsAreAsCloseAsTheirBitsAllow) {
  for (const bool edgebreaker : {false, true}) {
    const Scene scene = compressed_grid({edgebreaker, 14}).load();
    EXPECT_EQ(scene.triangles.size(), 288u);
    for (const Vertex& vertex : scene.vertices) {
      const float x = std::round(vertex.position.x), z = std::round(vertex.position.z);
      const vec3 expected(x, std::sin(0.3f * x) * std::cos(0.2f * z), z);
      EXPECT_LT(glm::length(vertex.position - expected), 12.0f / 16384.0f * 2.0f);
      EXPECT_LT(glm::length(vertex.uv0 - vec2(x, z) / 12.0f), 2.0f / 16384.0f);
      const vec3 normal = normalize(vec3(0.1f * std::cos(x), 1.0f, 0.1f * std::sin(z)));
      EXPECT_LT(glm::length(vertex.normal - normal), 1e-3f);
      EXPECT_FLOAT_EQ(vertex.color.x, x * 7.0f / 255.0f);
    }
  }
}

// Even where the plain data is there, the compressed data counts: the extension is known.
TEST(GltfDraco, OptionalUse) {
  GltfBuilder file = compressed_grid({}, true);
  file.json["bufferViews"][0]["byteOffset"] = file.json["bufferViews"][1]["byteOffset"];  // the plain positions are bad
  expect_same(file.load(), make_grid(12).load());
}

// The decoded faces are the triangles, whatever the plain indices would be.
TEST(GltfDraco, StripsAreDecodedToTriangles) {
  GltfBuilder file = compressed_grid({.edgebreaker = true});
  file.primitive()["mode"] = 5;
  EXPECT_EQ(shape_of(file.load()), shape_of(make_grid(12).load()));
}

TEST(GltfDraco, ValuesHaveTheTypeOfTheirAccessor) {
  GltfBuilder file = compressed_grid({});
  GltfJson& color = file.json["accessors"][3];
  ASSERT_EQ(color["componentType"], kUbyte);  // so is the stream
  color["componentType"] = kFloat;
  color.erase("normalized");
  expect_same(file.load(), make_grid(12).load());
  color["componentType"] = kUshort;  // of 65535: too dark, but as in the file
  color["normalized"] = true;
  EXPECT_FLOAT_EQ(file.load().vertices[1].color.x, 7.0f / 65535.0f);
}

TEST(GltfDraco, AttributesBesideTheStreamStayPlain) {
  GltfBuilder file = make_grid(12);
  GltfJson& attributes = file.primitive()["attributes"];
  const GltfJson color = attributes["COLOR_0"];
  attributes.erase("COLOR_0");
  compress_draco(file, file.primitive());
  attributes["COLOR_0"] = color;
  expect_same(file.load(), make_grid(12).load());
}

GltfBuilder skinned_and_morphed() {
  GltfBuilder file = make_grid(4);
  std::vector<uint8_t> joints;
  std::vector<float> weights, deltas;
  for (int i = 0; i < 25; i++) {
    joints.insert(joints.end(), {uint8_t(i % 2), uint8_t((i + 1) % 2), 0, 0});
    weights.insert(weights.end(), {0.75f, 0.25f, 0, 0});
    deltas.insert(deltas.end(), {0, float(i), 0});
  }
  GltfJson& attributes = file.primitive()["attributes"];
  attributes["JOINTS_0"] = file.add(joints, kUbyte, "VEC4");
  attributes["WEIGHTS_0"] = file.add(weights, kFloat, "VEC4");
  file.json["skins"] = GltfJson::parse(R"([{"joints": [1, 2]}])");
  file.json["nodes"] = GltfJson::parse(R"([{"mesh": 0, "skin": 0}, {}, {"translation": [0, 3, 0]}])");
  file.json["scenes"][0]["nodes"] = {0, 1, 2};
  file.json["meshes"][0]["weights"] = {0.5};
  file.primitive()["targets"] = {{{"POSITION", file.add(deltas, kFloat, "VEC3")}}};
  return file;
}

TEST(GltfDraco, SkinsAndMorphTargets) {
  GltfBuilder file = skinned_and_morphed();
  const Scene plain = file.load();
  compress_draco(file, file.primitive());
  const Scene packed = file.load();
  expect_same(packed, plain);
  ASSERT_EQ(packed.animation.deformations.size(), 1u);
  const auto &a = packed.animation.deformations[0].influences, &b = plain.animation.deformations[0].influences;
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); i++) {
    EXPECT_EQ(a[i].joint, b[i].joint);
    EXPECT_EQ(a[i].weight, b[i].weight);
  }
}

TEST(GltfDraco, MeshesOfSeveralNodes) {  // each skinned node reads its mesh for itself
  GltfBuilder file = skinned_and_morphed();
  file.json["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
  file.json["nodes"].push_back({{"mesh", 0}});
  file.json["scenes"][0]["nodes"] = {0, 1, 2, 3, 4};
  const Scene plain = file.load();
  compress_draco(file, file.primitive());
  expect_same(file.load(), plain);
}

TEST(GltfDraco, ManyPrimitives) {
  GltfBuilder file = make_grid(3);
  GltfJson& primitives = file.json["meshes"][0]["primitives"];
  for (int i = 0; i < 20; i++) {
    GltfJson copy = primitives[0];
    compress_draco(file, copy, {.edgebreaker = i % 2 == 0}, true);
    primitives.push_back(copy);
  }
  const Scene scene = file.load();
  EXPECT_EQ(scene.meshes.size(), 21u);
  EXPECT_EQ(scene.triangles.size(), 21u * 18u);
}

// A flat grid takes hardly any bytes, and is not a decompression bomb.
TEST(GltfDraco, SmallStreamsMayHoldMuch) {
  GltfBuilder file = make_grid(300);
  file.primitive()["attributes"] = {{"POSITION", file.primitive()["attributes"]["POSITION"]}};
  GltfJson ids;
  const Binary stream = draco_stream(file, file.primitive(), {true, 10}, &ids);
  GltfBuilder small = make_triangle();
  small.json["accessors"] = GltfJson::array({file.json["accessors"][0]});
  small.json["accessors"][0].erase("bufferView");
  small.binary.clear();
  small.json["bufferViews"] = GltfJson::array();
  extension_of(small) = {{"bufferView", small.add_view(stream)}, {"attributes", ids}};
  EXPECT_EQ(small.load().triangles.size(), 180000u);
}

// --- damage

TEST(GltfDracoDamage, MessagesNameThePrimitiveAndTheRemedy) {
  GltfBuilder file = compressed_grid({});
  stream_of(file)[0] = 'X';
  const std::string error = error_of(file.glb());
  EXPECT_NE(error.find("mesh 0, primitive 0"), std::string::npos) << error;
  EXPECT_NE(error.find("without compression"), std::string::npos) << error;
}

TEST(GltfDracoDamage, Headers) {
  struct Case {
    size_t byte;
    unsigned char value;
    const char* words;
  };
  for (const auto& [byte, value, words] :
       {Case{4, 'x', "not Draco data"}, Case{5, 1, "version 1.2"}, Case{6, 3, "version 2.3"},
        Case{7, 0, "points, not triangles"}, Case{7, 9, "points, not triangles"}, Case{8, 7, "unknown way"}}) {
    GltfBuilder file = compressed_grid({});
    stream_of(file)[byte] = value;
    EXPECT_NE(error_of(file.glb()).find(words), std::string::npos) << error_of(file.glb());
  }
}

TEST(GltfDracoDamage, CutAnywhere) {
  for (const bool edgebreaker : {false, true}) {
    GltfBuilder file = compressed_grid({edgebreaker, 11});
    const size_t size = stream_size(file);
    for (size_t length = 0; length < size; length += 1 + size / 100) {
      file.json["bufferViews"].back()["byteLength"] = length;
      EXPECT_NE(error_of(file.glb()), "") << length;
    }
  }
}

TEST(GltfDracoDamage, FlippedBits) {
  std::mt19937 random(5);
  for (const bool edgebreaker : {false, true}) {
    const GltfBuilder whole = compressed_grid({edgebreaker, 9});
    for (int round = 0; round < 300; round++) {
      GltfBuilder file = whole;
      for (int i = 0; i < 1 + round % 4; i++) {
        stream_of(file)[random() % stream_size(file)] ^= static_cast<unsigned char>(1u << random() % 8);
      }
      error_of(file.glb());
    }
  }
}

// A header that states a billion faces: 11 bytes of header, then the counts as varints.
TEST(GltfDracoDamage, CountsAreLimitedBeforeAnythingIsAllocated) {
  const Binary billion = {0x80, 0x94, 0xeb, 0xdc, 0x03}, hundred_million = {0x80, 0xc2, 0xd7, 0x2f};
  for (const Binary& faces : {billion, hundred_million}) {
    Binary stream = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, 1, 0, 0, 0, 100};  // edgebreaker, standard, 100 vertices
    stream.insert(stream.end(), faces.begin(), faces.end());
    stream.push_back(0);
    stream.insert(stream.end(), faces.begin(), faces.end());
    stream.insert(stream.end(), 100, 0);
    GltfBuilder file = compressed_grid({});
    extension_of(file)["bufferView"] = file.add_view(stream);
    EXPECT_NE(error_of(file.glb()).find("far more than a file of its size"), std::string::npos) << error_of(file.glb());
  }
}

// Counts that the stream states later: whichever four bytes are a large number, nothing takes long or is large.
TEST(GltfDracoDamage, LargeNumbersAnywhere) {
  for (const int speed : {0, 5}) {
    const GltfBuilder whole = compressed_grid({true, 10, speed});
    for (size_t at = 11; at + 4 <= stream_size(whole); at++) {
      GltfBuilder file = whole;
      std::memcpy(stream_of(file) + at, "\xff\xff\xff\x7f", 4);
      const std::clock_t start = std::clock();
      error_of(file.glb());
      EXPECT_LT(std::clock() - start, CLOCKS_PER_SEC) << at;
    }
  }
}

TEST(GltfDraco, EverySpeedOfTheEncoder) {
  for (int speed = 0; speed <= 10; speed++) {
    const Scene scene = compressed_grid({true, 12, speed}).load();
    EXPECT_EQ(scene.triangles.size(), 288u) << speed;
    for (const Vertex& vertex : scene.vertices) {
      EXPECT_LT(glm::length(12.0f * vertex.uv0 - vec2(vertex.position.x, vertex.position.z)), 0.02f) << speed;
    }
  }
}

// 255 attributes with seams of their own would take 24 bytes a corner each.
TEST(GltfDracoDamage, SeparateAttributesAreCounted) {
  Binary stream = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, 1, 0, 0, 0, 100, 0x80, 0x89, 0x7a, 255, 0x80, 0x89, 0x7a, 0};
  stream.insert(stream.end(), 100, 0);  // two million faces
  GltfBuilder file = compressed_grid({});
  extension_of(file)["bufferView"] = file.add_view(stream);
  EXPECT_NE(error_of(file.glb()).find("far more than a file of its size"), std::string::npos) << error_of(file.glb());
}

TEST(GltfDracoDamage, ReferencesAndCounts) {
  GltfBuilder file = compressed_grid({});
  extension_of(file)["attributes"]["POSITION"] = 77;
  EXPECT_NE(error_of(file.glb()).find("its POSITION is missing"), std::string::npos) << error_of(file.glb());
  file = compressed_grid({});
  extension_of(file)["bufferView"] = 77;
  EXPECT_NE(error_of(file.glb()).find("buffer view 77 does not exist"), std::string::npos);
  file = compressed_grid({});
  extension_of(file).erase("bufferView");
  EXPECT_NE(error_of(file.glb()).find("buffer view -1 does not exist"), std::string::npos);
  file = compressed_grid({});  // an attribute beside the stream, of another length
  file.primitive()["attributes"]["TEXCOORD_1"] = file.add<float>({0, 0, 1, 1}, kFloat, "VEC2");
  EXPECT_NE(error_of(file.glb()).find("169 positions, but 2 values of TEXCOORD_1"), std::string::npos);
}

TEST(GltfDracoDamage, TypesThatGltfDoesNotHave) {
  GltfBuilder file = compressed_grid({});
  const unsigned char uvs[] = {draco::GeometryAttribute::TEX_COORD, draco::DT_FLOAT32, 2, 0};  // the last attribute
  unsigned char* end = stream_of(file) + stream_size(file);
  unsigned char* found = std::search(stream_of(file), end, std::begin(uvs), std::end(uvs));
  ASSERT_NE(found, end);
  found[1] = draco::DT_BOOL;
  EXPECT_NE(error_of(file.glb()).find("a type that glTF does not have"), std::string::npos) << error_of(file.glb());
}

// Sequential streams hold their indices as they are.
TEST(GltfDracoDamage, IndicesOutOfRange) {
  GltfBuilder file = make_grid(1);
  file.primitive()["indices"] = file.add<uint32_t>({0, 1, 200, 0, 1, 2, 1, 2, 3, 1, 2, 3}, kUint, "SCALAR");
  compress_draco(file, file.primitive());
  EXPECT_NE(error_of(file.glb()).find("out of range"), std::string::npos) << error_of(file.glb());
}

}  // namespace
}  // namespace ods
