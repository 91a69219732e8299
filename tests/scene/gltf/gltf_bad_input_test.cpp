// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Whatever the bytes are: a Scene that keeps its promises (error_of checks that), or one line that names the file.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <random>

#include "ods/base/error.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::string error_of_text(const std::string& text) {
  return error_of(Binary(text.begin(), text.end()));
}

// A file that uses most of the reader: a textured, sparse, instanced mesh, a light and a camera.
GltfBuilder make_everything() {
  GltfBuilder file = make_triangle();
  auto& attributes = file.primitive()["attributes"];
  attributes["NORMAL"] = file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, kFloat, "VEC3");
  attributes["TEXCOORD_0"] = file.add<float>({0, 0, 1, 0, 0, 1}, kFloat, "VEC2");
  file.primitive()["indices"] = file.add<uint16_t>({0, 1, 2}, kUshort, "SCALAR");
  file.primitive()["material"] = 0;
  const int where = file.add<float>({1, 0, 0, 2, 0, 0}, kFloat, "VEC3");
  file.node(0)["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = where;
  file.json["images"] = {{{"bufferView", file.add_view(small_png())}, {"mimeType", "image/png"}}};
  file.json["textures"] = GltfJson::parse(R"([{"source": 0}])");
  file.json["materials"] = GltfJson::parse(R"([{"normalTexture": {"index": 0}, "emissiveTexture": {"index": 0}}])");
  file.json["cameras"] = GltfJson::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = GltfJson::parse(R"([{"type": "point"}])");
  file.node(0)["extensions"]["KHR_lights_punctual"]["light"] = 0;
  file.node(0)["camera"] = 0;
  return file;
}

TEST(GltfBadInput, TheWholeFileIsSound) {
  EXPECT_EQ(error_of(make_everything().glb()), "");
}

TEST(GltfBadInput, AbsentEmptyAndFolder) {
  const TemporaryFolder holder;
  const std::filesystem::path folder = holder.path(".");
  std::ofstream(folder / "empty.glb").flush();
  for (const std::string name : {"absent.glb", "empty.glb", ""}) {
    try {
      load_gltf((folder / name).string());
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      EXPECT_NE(std::string(error.what()).find((folder / name).string()), std::string::npos) << error.what();
    }
  }
}

TEST(GltfBadInput, CutAnywhere) {
  const Binary whole = make_everything().glb();
  for (size_t size = 0; size < whole.size(); size++) {
    EXPECT_NE(error_of(Binary(whole.begin(), whole.begin() + std::ptrdiff_t(size))), "") << size << " bytes";
  }
}

TEST(GltfBadInput, RandomBytesAndFlippedBits) {
  std::mt19937 random(1);
  const Binary whole = make_everything().glb();
  for (int round = 0; round < 3000; round++) {
    error_of(flip_bits(whole, 1 + round % 4, random));
    Binary noise(random() % 200);
    for (unsigned char& byte : noise) byte = static_cast<unsigned char>(random());
    EXPECT_NE(error_of(noise), "");
  }
}

TEST(GltfBadInput, NotGltf) {
  for (const std::string text : {"{}", "[]", "null", "{\"asset\": 1}", "hello", "{\"asset\": {\"version\": \"1.0\"}}",
                                 "{\"asset\": {\"version\": \"2.0\"}, \"nodes\": {}, \"x\": 1e999}"}) {
    EXPECT_NE(error_of_text(text), "") << text;
  }
}

// Neither absent nor too large: the system's error is reported.
TEST(GltfBadInput, FilesThatCannotBeReached) {
  GltfBuilder file = make_triangle();
  file.json["buffers"] = {{{"byteLength", file.binary.size()}, {"uri", std::string(300, 'a')}}};
  const std::string error = error_of_text(file.json.dump());
  EXPECT_NE(error.find("File name too long"), std::string::npos) << error;
  EXPECT_EQ(error.find("no such file"), std::string::npos) << error;
}

TEST(GltfBadInput, DeepJson) {
  EXPECT_NE(error_of_text(std::string(100000, '[')), "");
  EXPECT_NE(error_of_text(R"({"asset": {"version": "2.0"}, "extras": )" + std::string(100000, '[') +
                          std::string(100000, ']') + "}"),
            "");
  EXPECT_EQ(error_of_text(R"({"asset": {"version": "2.0"}, "extras": "[[[[" })"), "");
}

// Each of these breaks one thing in a valid file; the answer must be an Error with this text.
struct Breakage {
  const char* path;  // JSON pointer
  const char* value;
  const char* words;
};

class GltfBreakage : public testing::TestWithParam<Breakage> {};

TEST_P(GltfBreakage, IsAnError) {
  GltfBuilder file = make_everything();
  file.json[GltfJson::json_pointer(GetParam().path)] = GltfJson::parse(GetParam().value);
  const std::string error = error_of(file.glb());
  EXPECT_FALSE(error.empty()) << GetParam().path;
  EXPECT_NE(error.find(GetParam().words), std::string::npos) << GetParam().path << ": '" << error << "'";
}

INSTANTIATE_TEST_SUITE_P(
    All, GltfBreakage,
    testing::Values(
        Breakage{"/accessors/0/count", "1000000000000000000", "runs past the end"},
        Breakage{"/accessors/0/count", "18446744073709551615", "runs past the end"},
        Breakage{"/accessors/0/count", "4", "runs past the end"}, Breakage{"/accessors/0/count", "-1", ""},
        Breakage{"/accessors/0/byteOffset", "18446744073709551615", "runs past the end"},
        Breakage{"/accessors/0/bufferView", "99", "buffer view 99 does not exist"},
        Breakage{"/accessors/1/count", "2", "3 positions, but 2 values of NORMAL"},
        Breakage{"/accessors/3/componentType", "5126", ""},
        Breakage{"/accessors/3/count", "1000000000000000000", "runs past the end"},
        Breakage{"/accessors/0", R"({"componentType": 5126, "type": "VEC3", "count": 1000000000000000})", "far more"},
        Breakage{"/accessors/0/sparse",
                 R"({"count": 9, "indices": {"bufferView": 3, "componentType": 5123}, "values": {"bufferView": 0}})",
                 "runs past the end"},
        Breakage{
            "/accessors/0/sparse",
            R"({"count": 1, "indices": {"bufferView": 0, "byteOffset": 12, "componentType": 5125}, "values": {"bufferView": 0}})",
            "index out of range"},
        Breakage{"/bufferViews/0/byteLength", "18446744073709551615", "runs past the end"},
        Breakage{"/bufferViews/0/byteOffset", "18446744073709551615", "runs past the end"},
        Breakage{"/bufferViews/0/buffer", "7", "buffer 7 does not exist"},
        Breakage{"/buffers", R"([{"byteLength": 1000000000000000000}])", "buffer 0 has"},
        Breakage{"/buffers", R"([{"byteLength": -5}])", "negative value of byteLength"},
        Breakage{"/buffers", R"([{"byteLength": 8, "uri": "nowhere.bin"}])", "refers to nowhere.bin: no such file"},
        Breakage{"/buffers", R"([{"byteLength": 8, "uri": "https://example.org/a.bin"}])", "network"},
        Breakage{"/buffers", R"([{"byteLength": 8, "uri": "."}])", "refers to .: it is not a file"},
        Breakage{"/images/0", "{}", "buffer view -1 does not exist"},
        Breakage{"/images/0", R"({"uri": "data:image/png;base64,"})", "image 0 is empty"},
        Breakage{"/images/0/bufferView", "0", "image 0"},
        Breakage{"/materials/0/normalTexture/index", "5", "texture 5 does not exist"},
        Breakage{"/meshes/0/primitives/0/attributes/POSITION", "77", "accessor 77 does not exist"},
        Breakage{"/meshes/0/primitives/0/attributes/POSITION", "2", "POSITION needs 3"},
        Breakage{"/meshes/0/primitives/0/indices", "0", "unsigned integers"},
        Breakage{"/meshes/0/primitives/0/material", "3", "material 3 does not exist"},
        Breakage{"/meshes/0/primitives/0/mode", "9", "mode 9"}, Breakage{"/nodes/0/mesh", "1", "mesh 1 does not exist"},
        Breakage{"/nodes/0/camera", "1", "camera 1 does not exist"},
        Breakage{"/nodes/0/extensions/KHR_lights_punctual/light", "1", "light 1 does not exist"},
        Breakage{"/nodes/0/children", "[0]", "own ancestors"},
        Breakage{"/nodes/0/children", "[1]", "node 1 does not exist"},
        Breakage{"/nodes", R"([{"children": [1]}, {"children": [2]}, {"children": [1]}])", "child of both"},
        Breakage{"/nodes", R"([{}, {"children": [2]}, {"children": [1]}])", "own ancestors"},
        Breakage{"/nodes", R"([{"children": [2]}, {"children": [2]}, {}])", "child of both"},
        Breakage{"/nodes/0/matrix", "[1e300,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]", "not finite"},
        Breakage{"/nodes/0/translation", "[1e10, 0, 0]", "not finite, or too large"},
        Breakage{"/scene", "5", "has no scene 5"}, Breakage{"/scenes/0/nodes", "[4]", "node 4 does not exist"},
        Breakage{"/textures/0/source", "2", "image 2 does not exist"},
        Breakage{"/textures/0/sampler", "2", "sampler 2 does not exist"}));

TEST(GltfBadInput, IndicesOutOfRange) {
  GltfBuilder file = make_triangle();
  file.primitive()["indices"] = file.add<uint32_t>({0, 1, 3}, kUint, "SCALAR");
  EXPECT_NE(error_of(file.glb()).find("has the index 3, but there are 3 vertices"), std::string::npos);
}

TEST(GltfBadInput, ASmallFileCannotAskForMuch) {
  GltfBuilder file = make_triangle();  // a thousand meshes of a million corners, from one accessor of zeros
  std::vector<uint8_t> zeros(100000, 0);
  file.add(zeros, kUbyte, "SCALAR");
  const GltfJson primitive = {{"attributes", {{"POSITION", 0}}}, {"indices", 1}};
  file.json["meshes"][0]["primitives"] = std::vector<GltfJson>(1000, primitive);
  EXPECT_NE(error_of(file.glb()).find("far more geometry"), std::string::npos);
}

TEST(GltfBadInput, OnePictureUnderManyNamesIsReadOnce) {
  GltfBuilder file = make_triangle();
  const int view = file.add_view(small_png());
  for (int i = 0; i < 100; i++) {
    file.json["images"].push_back({{"bufferView", view}});
    file.json["textures"].push_back({{"source", i}});
    file.json["materials"].push_back({{"emissiveTexture", {{"index", i}}}});
  }
  const Scene scene = file.load();
  EXPECT_EQ(scene.textures.size(), 100u);
  EXPECT_EQ(scene.texels.size(), 4u);
}

void append_chunk(Binary& png, const std::string& type, const Binary& data) {
  Binary typed(type.begin(), type.end());
  typed.insert(typed.end(), data.begin(), data.end());
  uint32_t crc = 0xffffffffu;
  for (const unsigned char byte : typed) {
    crc ^= byte;
    for (int bit = 0; bit < 8; bit++) crc = crc >> 1 ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
  }
  const auto append = [&](size_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) png.push_back(static_cast<unsigned char>(value >> shift));
  };
  append(data.size());
  png.insert(png.end(), typed.begin(), typed.end());
  append(~crc);
}

// 4096 x 4096 texels of one bit, all black, in 2 kB: next to all of its packed bytes are zero.
Binary vast_png() {
  Binary pixels = {0x78, 0xda, 0xed, 0xc1, 0x31, 0x01, 0x00, 0x00, 0x00,
                   0xc2, 0xa0, 0xf5, 0x4f, 0x6d, 0x0a, 0x3f, 0xa0};
  pixels.resize(2059 - 6);
  pixels.insert(pixels.end(), {0xbe, 0x06, 0x11, 0xe0, 0x00, 0x01});
  Binary png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  append_chunk(png, "IHDR", {0, 0, 0x10, 0, 0, 0, 0x10, 0, 1, 0, 0, 0, 0});
  append_chunk(png, "IDAT", pixels);
  append_chunk(png, "IEND", {});
  return png;
}

// Five of them are more than 64 million texels and a thousand for each byte; their order does not matter.
TEST(GltfBadInput, TexelsThatAFileOfItsSizeCannotHold) {
  GltfBuilder file = make_triangle();
  for (int i = 0; i < 5; i++) {
    file.json["images"].push_back({{"bufferView", file.add_view(vast_png())}});
    file.json["textures"].push_back({{"source", i}});
    file.json["materials"].push_back({{"emissiveTexture", {{"index", i}}}});
  }
  EXPECT_NE(error_of(file.glb()).find("far more texels"), std::string::npos);
  file.json["materials"].erase(4);
  EXPECT_EQ(error_of(file.glb()), "");
}

// --- files that are larger than what is in them (sparse: they take no room on the disk) ------------------------------

class GltfSparseFile : public testing::Test {
 protected:
  static constexpr uintmax_t kHuge = uintmax_t{1} << 43;

  void write(const std::string& name, const Binary& bytes) {
    folder.write(name, std::string(bytes.begin(), bytes.end()));
    std::error_code error;
    std::filesystem::resize_file(folder.path(name), kHuge, error);
    if (error) GTEST_SKIP() << "skipped: no sparse files of 8 TB here: " << error.message();
  }
  std::string error_of_file(const std::string& name) const {
    try {
      load_gltf(folder.path(name));
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  }

  TemporaryFolder folder;
};

TEST_F(GltfSparseFile, AContainerEndsWhereItsHeaderSays) {
  write("a.glb", make_triangle().glb());
  EXPECT_EQ(error_of_file("a.glb"), "");
}

TEST_F(GltfSparseFile, TextHasALimit) {
  write("a.gltf", {'{'});
  EXPECT_NE(error_of_file("a.gltf").find("limit"), std::string::npos) << error_of_file("a.gltf");
  write("b.gltf", {'x'});
  EXPECT_NE(error_of_file("b.gltf").find("is not a glTF file"), std::string::npos);
}

TEST_F(GltfSparseFile, BuffersAreReadAsFarAsTheyAreUsed) {
  GltfBuilder file = make_triangle();
  write("a.bin", file.binary);
  file.json["buffers"] = {{{"byteLength", file.binary.size()}, {"uri", "a.bin"}}};
  folder.write("a.gltf", file.json.dump());
  EXPECT_EQ(error_of_file("a.gltf"), "");
  file.json["buffers"][0]["byteLength"] = kHuge;
  folder.write("a.gltf", file.json.dump());
  EXPECT_NE(error_of_file("a.gltf").find("needs 8796.1 GB of memory"), std::string::npos) << error_of_file("a.gltf");
}

TEST_F(GltfSparseFile, Pictures) {
  write("a.png", small_png());
  GltfBuilder file = make_triangle();
  file.json["images"] = {{{"uri", "a.png"}}};
  file.json["textures"] = GltfJson::parse(R"([{"source": 0}])");
  file.json["materials"] = GltfJson::parse(R"([{"emissiveTexture": {"index": 0}}])");
  file.json["buffers"] = {{{"byteLength", file.binary.size()}, {"uri", "a.bin"}}};
  folder.write("a.bin", std::string(file.binary.begin(), file.binary.end()));
  folder.write("a.gltf", file.json.dump());
  EXPECT_NE(error_of_file("a.gltf").find("limit"), std::string::npos) << error_of_file("a.gltf");
}

TEST(GltfBadInput, VerticesThatAreNowhere) {
  for (const float bad : {kNan, kInfinity, -kInfinity, 1e30f}) {
    GltfBuilder file = make_triangle();  // one sound triangle, one with a bad corner
    file.primitive()["attributes"]["POSITION"] =
        file.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, bad, 0, 0}, kFloat, "VEC3");
    file.primitive()["indices"] = file.add<uint8_t>({0, 1, 2, 1, 2, 3}, kUbyte, "SCALAR");
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(scene.warnings.size(), 1u);
  }
}

TEST(GltfBadInput, BadNumbersInOtherAttributes) {
  for (const float bad : {kNan, kInfinity, 1e38f, -1e38f}) {
    GltfBuilder file = make_triangle();
    auto& attributes = file.primitive()["attributes"];
    attributes["NORMAL"] = file.add<float>({bad, 0, 0, 0, 0, 0, 0, 0, 1e-30f}, kFloat, "VEC3");
    attributes["TANGENT"] = file.add<float>({bad, 0, 0, bad, 0, 0, 0, 0, 1, bad, bad, bad}, kFloat, "VEC4");
    attributes["TEXCOORD_0"] = file.add<float>({bad, 0, 0, bad, 0, 0}, kFloat, "VEC2");
    attributes["COLOR_0"] = file.add<float>({bad, 0, 0, 0, bad, 0, -1, 2, bad}, kFloat, "VEC3");
    EXPECT_EQ(file.load().triangles.size(), 1u);
  }
}

TEST(GltfBadInput, NormalsOfNoLengthAreRepaired) {
  GltfBuilder file = make_triangle();
  file.primitive()["attributes"]["NORMAL"] = file.add<float>({0, 0, 0, 0, 3, 0, 0, 0, 0}, kFloat, "VEC3");
  const Scene scene = file.load();
  EXPECT_EQ(scene.vertices[0].normal, vec3(0, 0, 1));  // the face's
  EXPECT_EQ(scene.vertices[1].normal, vec3(0, 1, 0));  // its own, at unit length
}

TEST(GltfBadInput, TrianglesWithoutAnAreaAreLeftOut) {
  GltfBuilder file = make_triangle();
  file.primitive()["attributes"]["POSITION"] = file.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0}, kFloat, "VEC3");
  file.primitive()["indices"] = file.add<uint8_t>({0, 1, 2, 0, 1, 1, 0, 1, 3}, kUbyte, "SCALAR");
  EXPECT_EQ(file.load().triangles.size(), 1u);
}

TEST(GltfBadInput, FlattenedInstancesAreLeftOut) {
  GltfBuilder file = make_triangle();
  file.json["scenes"][0]["nodes"] = {0, 1, 2};
  file.json["nodes"] = GltfJson::parse(R"([{"mesh": 0, "scale": [1, 0, 1]}, {"mesh": 0},
      {"mesh": 0, "matrix": [1,1,0,0, 1,1,0,0, 0,0,1,0, 0,0,0,1]}])");
  const Scene scene = file.load();
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(GltfBadInput, InstancesThatAreNowhere) {
  GltfBuilder file = make_triangle();
  const int where = file.add<float>({1, 0, 0, kNan, 0, 0}, kFloat, "VEC3");
  file.node(0)["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = where;
  EXPECT_NE(error_of(file.glb()).find("not finite"), std::string::npos);
}

TEST(GltfBadInput, FactorsAreBroughtIntoRange) {
  GltfBuilder file = make_triangle();
  file.json["materials"] = GltfJson::parse(R"([{
      "pbrMetallicRoughness": {"baseColorFactor": [-1, 2, 1e300, 5], "metallicFactor": 7, "roughnessFactor": -3},
      "emissiveFactor": [1e300, -1, 1], "alphaMode": "PERHAPS", "alphaCutoff": -1e300,
      "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 1e300}, "KHR_materials_ior": {"ior": -2},
                     "KHR_materials_transmission": {"transmissionFactor": 1e300},
                     "KHR_materials_volume": {"thicknessFactor": -1e300, "attenuationDistance": 1e300}}}, {}])");
  const Material material = file.load().materials.at(0);
  EXPECT_EQ(material.base_color, vec4(0, 1, 1, 1));
  EXPECT_EQ(material.ior, 1.5f);
}

TEST(GltfBadInput, LongNamesDoNotFloodAMessage) {
  GltfBuilder file = make_triangle();
  file.json["extensionsRequired"] = {std::string(100000, 'x') + "\n"};
  EXPECT_LT(error_of(file.glb()).size(), 300u);
}

TEST(GltfBadInput, SharedSceneWithFlippedBits) {
  const std::filesystem::path path = std::filesystem::path(shared_scenes()) / "atrium.glb";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "skipped: no ../shared/scenes beside the sources";
  std::ifstream stream(path, std::ios::binary);
  Binary whole(std::filesystem::file_size(path));
  stream.read(reinterpret_cast<char*>(whole.data()), std::streamsize(whole.size()));
  std::mt19937 random(2);
  for (int round = 0; round < 6; round++) {
    Binary bytes = whole;
    // One in the header and the JSON, a thousand anywhere.
    bytes[random() % 380000] ^= static_cast<unsigned char>(1u << random() % 8);
    for (int i = 0; i < 1000; i++) bytes[380000 + random() % (bytes.size() - 380000)] ^= 64;
    error_of(bytes);
  }
}

}  // namespace
}  // namespace ods
