// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// JSON as in glTF: whole numbers as reals, absent data, skipped parts, limits.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <span>

#include "ods/scene/gltf/json.h"
#include "tests/support/gltf_builder.h"

namespace ods::gltf_json_test {

// Every whole number of a document written as a real: 3 becomes 3.0.
void write_as_reals(GltfJson& json) {
  if (json.is_number_integer()) json = json.get<double>();
  if (json.is_structured()) {
    for (GltfJson& value : json) write_as_reals(value);
  }
}

GltfBuilder make_moving() {
  GltfBuilder file = make_triangle();
  auto& attributes = file.primitive()["attributes"];
  attributes["JOINTS_0"] = file.add<uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, kUbyte, "VEC4");
  attributes["WEIGHTS_0"] = file.add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, kFloat, "VEC4");
  file.primitive()["indices"] = file.add<uint16_t>({0, 1, 2}, kUshort, "SCALAR");
  file.primitive()["material"] = 0;
  file.json["images"] = {{{"bufferView", file.add_view(small_png())}, {"mimeType", "image/png"}}};
  file.json["textures"] = GltfJson::parse(R"([{"source": 0, "sampler": 0}])");
  file.json["samplers"] = GltfJson::parse(R"([{"wrapS": 33071}])");
  file.json["materials"] = GltfJson::parse(R"([{"emissiveTexture": {"index": 0}}])");
  file.json["cameras"] = GltfJson::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
  file.json["skins"] = GltfJson::parse(R"([{"joints": [1, 2]}])");
  file.json["scenes"] = GltfJson::parse(R"([{"nodes": [0, 1]}])");
  file.json["nodes"] = GltfJson::parse(R"([{"mesh": 0, "skin": 0}, {"children": [2], "camera": 0}, {}])");
  const int times = file.add<float>({0, 1}, kFloat, "SCALAR");
  const int places = file.add<float>({0, 0, 0, 2, 0, 0}, kFloat, "VEC3");
  file.json["animations"] = {{{"samplers", {{{"input", times}, {"output", places}}}},
                              {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}}};
  return file;
}

TEST(GltfJson, WholeNumbersMayBeReals) {
  GltfBuilder file = make_moving();
  write_as_reals(file.json);
  const Scene scene = file.load();
  EXPECT_EQ(scene.triangles.size(), 1u);
  EXPECT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.view_points.size(), 1u);
  EXPECT_EQ(scene.animation.skins.size(), 1u);
  EXPECT_EQ(scene.animation.clips.size(), 1u);
}

TEST(GltfJson, NumbersThatAreNotWholeAreNoIndices) {
  GltfBuilder file = make_triangle();
  file.primitive()["attributes"]["POSITION"] = 0.5;
  EXPECT_NE(error_of(file.glb()).find("POSITION"), std::string::npos);
  file = make_triangle();
  file.json["accessors"][0]["count"] = 2.5;
  EXPECT_NE(error_of(file.glb()).find("count"), std::string::npos);
}

TEST(GltfJson, LargeNumbersAreNotCutToSmallOnes) {
  GltfBuilder file = make_triangle();
  file.node(0)["mesh"] = int64_t{1} << 32;  // 0 in 32 bits
  EXPECT_NE(error_of(file.glb()).find("does not exist"), std::string::npos);
  file = make_triangle();
  file.primitive()["material"] = 0;
  file.json["materials"] = GltfJson::parse(
      R"([{"emissiveFactor": [1, 1, 1], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 0}}}])");
  file.json["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 50000000;
  EXPECT_EQ(file.load().materials[0].emission.x, 5e7f);
  file.json["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = int64_t{1} << 33;
  EXPECT_EQ(file.load().materials[0].emission.x, 1e9f);  // the brightest there is
}

// The specification: "When undefined, the data MUST be initialized with zeros".
TEST(GltfJson, AccessorsWithoutABufferViewAreZeros) {
  GltfBuilder file = make_triangle();
  for (const char* name : {"TEXCOORD_0", "COLOR_0"}) {
    file.primitive()["attributes"][name] = file.json["accessors"].size();
    const char* type = std::string_view(name) == "COLOR_0" ? "VEC4" : "VEC2";
    file.json["accessors"].push_back({{"componentType", kFloat}, {"count", 3}, {"type", type}});
  }
  const Scene scene = file.load();
  ASSERT_EQ(scene.vertices.size(), 3u);
  EXPECT_EQ(scene.vertices[2].uv0, vec2(0.0f));
  EXPECT_EQ(scene.vertices[2].color, vec4(0.0f));
}

TEST(GltfJson, SparseIndicesWithoutABufferView) {
  GltfBuilder file = make_triangle();
  const int where = file.add<uint8_t>({1, 2}, kUbyte, "SCALAR"), what = file.add<uint16_t>({1, 2}, kUshort, "SCALAR");
  const auto view = [&](int accessor) { return file.json["accessors"][size_t(accessor)]["bufferView"]; };
  file.primitive()["indices"] = file.json["accessors"].size();
  file.json["accessors"].push_back({{"componentType", kUshort},
                                    {"count", 3},
                                    {"type", "SCALAR"},
                                    {"sparse",
                                     {{"count", 2},
                                      {"indices", {{"bufferView", view(where)}, {"componentType", kUbyte}}},
                                      {"values", {{"bufferView", view(what)}}}}}});
  const Scene scene = file.load();
  ASSERT_EQ(scene.triangles.size(), 1u);
  EXPECT_EQ(scene.triangles[0], uvec3(0, 1, 2));
}

// Zeros are a triangle without an area: nothing to render, and no damage.
TEST(GltfJson, IndicesWithoutABufferView) {
  GltfBuilder file = make_triangle();
  file.primitive()["indices"] = file.json["accessors"].size();
  file.json["accessors"].push_back({{"componentType", kUshort}, {"count", 3}, {"type", "SCALAR"}});
  EXPECT_EQ(error_of(file.glb()), "");
}

TEST(GltfJson, SkipsWhatReadersDoNotKnow) {
  GltfBuilder file = make_triangle();
  file.json["extras"] = GltfJson::parse(R"({"a": [{"b": {}}, []], "c": null})");
  file.json["mine"] = GltfJson::parse(R"({"nodes": 1})");
  file.node(0)["extras"] = 5;
  file.node(0)["extensions"] = GltfJson::parse(R"({"MY_extension": {"mesh": [1, [2]]}})");
  file.json["extensions"] =
      GltfJson::parse(R"({"KHR_lights_punctual": {"lights": [{"type": "point", "extras": "x"}]}})");
  file.node(0)["extensions"]["KHR_lights_punctual"] = {{"light", 0}};
  const Scene scene = file.load();
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.triangles.size(), 1u);
  const std::string many(1000, '[');
  EXPECT_NE(error_of(make_glb(R"({"asset": {"version": "2.0"}, "extras": )" + many, {})).find("too deeply"),
            std::string::npos);
}

// JSON that would take a hundred times the size of the text.
TEST(GltfJson, ExtrasTakeNoMemory) {
  std::string text = R"({"asset": {"version": "2.0"}, "extras": [)";
  for (int i = 0; i < 1'000'000; i++) text += "{},0,";
  text += "[]]}";
  const auto bytes = std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size());
  const JsonDocument document = parse_gltf_json(bytes, "test.glb", [](std::string_view) { return true; });
  EXPECT_EQ(document.values.size(), 3u);  // the root, its asset, the version
  EXPECT_LE(document.values.capacity(), 64u);
}

TEST(GltfJson, TheLastMemberOfANameCounts) {
  const std::string text = R"({"asset": {"version": "1.0"}, "asset": {"version": "2.0", "version": "2.1"}})";
  EXPECT_EQ(error_of(make_glb(text, {})), "");
}

// Work that grows with the square of the file's size.
TEST(GltfJson, ManyNodesOfManyPrimitives) {
  GltfBuilder file = make_triangle();
  file.json["meshes"][0]["primitives"] = std::vector<GltfJson>(2000, GltfJson::object());
  file.json["nodes"] = std::vector<GltfJson>(2000, GltfJson{{"mesh", 0}});
  file.json.erase("scenes");
  EXPECT_NE(error_of(file.glb()).find("far more geometry"), std::string::npos);
}

TEST(GltfJson, ManyReasonsToWarn) {
  GltfBuilder file = make_triangle();
  for (int i = 0; i < 1000; i++) {
    file.json["textures"].push_back(GltfJson::object());
    file.json["materials"].push_back({{"emissiveTexture", {{"index", i}}}});
  }
  EXPECT_EQ(file.load().warnings.size(), 100u);
}

TEST(GltfJson, ObjectsWithManyMembersAreRefused) {
  GltfBuilder file = make_triangle();
  for (int i = 0; i < 300; i++) file.primitive()["attributes"][fmt::format("_{}", i)] = 0;
  EXPECT_NE(error_of(file.glb()).find("members"), std::string::npos);
}

}  // namespace ods::gltf_json_test
