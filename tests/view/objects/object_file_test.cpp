// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/objects/object_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <span>

#include "ods/base/error.h"
#include "ods/image/image_file.h"
#include "ods/scene/load/load.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/scenes.h"

namespace ods::object_file_test {

struct Parsed {
  GltfJson json;
  std::string binary;

  template <class T>
  std::vector<T> values(const GltfJson& accessor_number) const {
    const GltfJson& accessor = json["accessors"][accessor_number.get<size_t>()];
    const GltfJson& view = json["bufferViews"][accessor["bufferView"].get<size_t>()];
    std::vector<T> values(view["byteLength"].get<size_t>() / sizeof(T));
    std::memcpy(values.data(), binary.data() + view["byteOffset"].get<size_t>(), values.size() * sizeof(T));
    return values;
  }
  const GltfJson& primitive(size_t mesh = 0) const { return json["meshes"][mesh]["primitives"][0]; }
  const GltfJson& about() const { return json["asset"]["extras"]["omnistereo"]; }
};

Parsed parsed(const std::string& glb) {
  uint32_t size = 0;
  std::memcpy(&size, glb.data() + 12, sizeof size);
  return {GltfJson::parse(glb.substr(20, size)), glb.substr(28 + size)};
}

Scene read_back(const std::string& glb) {
  return load_gltf_bytes({reinterpret_cast<const unsigned char*>(glb.data()), glb.size()}, "object.glb");
}

TEST(ObjectFile, HasTheSurfacesOfTheScene) {
  const Scene scene = load_scene("wineglass");
  const ObjectFile file = make_object_file(scene, "wineglass");
  EXPECT_EQ(file.note, "");
  const Scene again = read_back(file.glb);
  ASSERT_GT(again.instances.size(), 0u);
  const Bounds a = scene_bounds(scene), b = scene_bounds(again);
  EXPECT_LT(length(a.low - b.low) + length(a.high - b.high), 1e-4f);
  EXPECT_TRUE(again.warnings.empty()) << again.warnings.front();
  const Parsed json = parsed(file.glb);
  EXPECT_FALSE(json.json.contains("extensionsUsed"));
  EXPECT_EQ(json.about()["object"], 1);
  EXPECT_EQ(json.about()["frames"], 1);
}

// A quad with a texture, whose transform is applied, and factors that textures and vertex colours change.
TEST(ObjectFile, HasPlainMaterials) {
  Scene scene;
  scene.texels = {0xff0000ffu, 0xff00ff00u};  // red, green
  Texture texture{};
  texture.width = 2, texture.height = 1, texture.srgb = 1, texture.wrap_u = kWrapMirror, texture.wrap_v = kWrapClamp;
  scene.textures = {texture};
  Material material = default_material();
  material.base_color = vec4(0.5f, 1.0f, 1.0f, 1.0f);
  material.metallic = 0.8f, material.roughness = 0.6f, material.double_sided = 0;
  material.emission = vec3(3.0f, 0.0f, 1.0f);
  material.base_color_slot.texture = 0;
  material.base_color_slot.offset = vec2(0.25f, 0.5f);
  material.base_color_slot.axis_u = vec2(2.0f, 0.0f);
  material.metallic_roughness_slot.texture = 0;  // g: 1/2 in the mean, b: 0
  std::vector<Vertex> vertices;
  for (const vec3& p : {vec3(0), vec3(1, 0, 0), vec3(0, 1, 0)}) {
    vertices.push_back({p, vec3(0, 0, 1), vec4(0.0f), vec2(p.x, p.y), vec2(9.0f), vec4(0.5f, 1, 1, 1)});
  }
  add_instance(scene, add_mesh(scene, vertices, {{0, 1, 2}}, add_material(scene, material)), glm::mat4(1.0f));
  const Parsed file = parsed(make_object_file(scene, "quad").glb);
  const GltfJson &written = file.json["materials"][0], &surface = written["pbrMetallicRoughness"];
  EXPECT_NEAR(surface["baseColorFactor"][0].get<float>(), 0.25f, 1e-6f);
  EXPECT_NEAR(surface["metallicFactor"].get<float>(), 0.0f, 1e-6f);
  EXPECT_NEAR(surface["roughnessFactor"].get<float>(), 0.3f, 1e-6f);
  EXPECT_EQ(written["emissiveFactor"][0], 3.0f);
  EXPECT_EQ(written["doubleSided"], false);
  EXPECT_FALSE(written.contains("alphaMode"));
  EXPECT_EQ(file.json["samplers"][0]["wrapS"], 33648);
  EXPECT_EQ(file.json["samplers"][0]["wrapT"], 33071);
  EXPECT_EQ(file.json["images"][0]["mimeType"], "image/jpeg");
  const auto uvs = file.values<vec2>(file.primitive()["attributes"]["TEXCOORD_0"]);
  EXPECT_EQ(uvs[1], vec2(2.25f, 0.5f));
  EXPECT_EQ(file.values<uint>(file.primitive()["indices"]), (std::vector<uint>{0, 1, 2}));
  EXPECT_EQ(file.values<vec3>(file.primitive()["attributes"]["NORMAL"])[2], vec3(0, 0, 1));

  scene.materials[0].alpha_mode = kAlphaMask, scene.materials[0].alpha_cutoff = 0.25f;
  const Parsed masked = parsed(make_object_file(scene, "quad").glb);
  EXPECT_EQ(masked.json["images"][0]["mimeType"], "image/png");
  EXPECT_EQ(masked.json["materials"][0]["alphaMode"], "MASK");
  EXPECT_EQ(masked.json["materials"][0]["alphaCutoff"], 0.25f);
  scene.materials[0].alpha_mode = kAlphaOpaque, scene.materials[0].transmission = 1.0f;
  const Parsed glass = parsed(make_object_file(scene, "quad").glb);
  EXPECT_EQ(glass.json["materials"][0]["alphaMode"], "BLEND");
}

// A triangle that moves by 1 m to the right and is deformed by a morph target, both in `seconds`.
GltfBuilder moving(float seconds) {
  GltfBuilder file = make_triangle();
  const int times = file.add<float>({0.0f, seconds}, kFloat, "SCALAR");
  const int places = file.add<float>({0, 0, 0, 1, 0, 0}, kFloat, "VEC3");
  const int weights = file.add<float>({0.0f, 1.0f}, kFloat, "SCALAR");
  const int up = file.add<float>({0, 0, 0, 0, 0, 0, 0, 2, 0}, kFloat, "VEC3");
  file.primitive()["targets"] = {{{"POSITION", up}}};
  file.json["animations"] = {
      {{"samplers", {{{"input", times}, {"output", places}}, {{"input", times}, {"output", weights}}}},
       {"channels",
        {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
         {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
  return file;
}

TEST(ObjectFile, Moves) {
  const ObjectFile file = make_object_file(moving(2.0f).load(), "moving");
  EXPECT_EQ(file.note, "");
  const Parsed json = parsed(file.glb);
  EXPECT_EQ(json.about()["frames"], 60);
  EXPECT_EQ(json.about()["rate"], 30.0);
  const auto matrices = json.values<glm::mat4>(json.json["nodes"][0]["extras"]["omnistereo"]["matrices"]);
  ASSERT_EQ(matrices.size(), 60u);
  EXPECT_NEAR(matrices[30][3].x, 0.5f, 1e-5f);
  const GltfJson& frames = json.primitive()["extras"]["omnistereo"]["frames"];
  ASSERT_EQ(frames.size(), 60u);
  EXPECT_NEAR(json.values<vec3>(frames[15]["POSITION"])[2].y, 1.0f + 2.0f * 0.25f, 1e-5f);
  EXPECT_EQ(json.values<vec3>(frames[15]["NORMAL"]).size(), 3u);
  EXPECT_EQ(frames[0]["POSITION"], json.primitive()["attributes"]["POSITION"]);
  EXPECT_EQ(read_back(file.glb).instances.size(), 1u);
}

TEST(ObjectFile, StandsStillIfTheAnimationIsLong) {
  const ObjectFile file = make_object_file(moving(11.0f).load(), "moving");
  EXPECT_NE(file.note.find("11 s"), std::string::npos) << file.note;
  EXPECT_EQ(parsed(file.glb).about()["frames"], 1);
  EXPECT_FALSE(parsed(file.glb).json["nodes"][0].contains("extras"));
}

TEST(ObjectFile, NeedsTrianglesButNotTooMany) {
  EXPECT_THROW(make_object_file({}, "empty"), Error);
  Scene scene;
  const int material = add_material(scene, default_material());
  const int mesh = add_mesh(scene, std::vector<Vertex>(3), std::vector<uvec3>(1000, uvec3(0, 1, 2)), material);
  for (int i = 0; i < 1001; i++) add_instance(scene, mesh, glm::mat4(1.0f));
  try {
    make_object_file(scene, "large.glb");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_NE(std::string(error.what()).find("'large.glb' is too large"), std::string::npos) << error.what();
  }
}

}  // namespace ods::object_file_test
