// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/gltf/gltf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "ods/base/error.h"
#include "ods/kernel/microfacets.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/places.h"
#include "tests/support/scene_check.h"
#include "tests/support/temporary_folder.h"

namespace ods::gltf_test {

void expect_near(vec3 actual, vec3 expected, float tolerance = 1e-5f) {
  for (int i = 0; i < 3; i++) EXPECT_NEAR(actual[i], expected[i], tolerance) << "component " << i;
}

vec3 world_of(const Scene& scene, size_t instance, vec3 p) {
  const Instance& i = scene.instances[instance];
  return vec3(dot(i.row0, vec4(p, 1.0f)), dot(i.row1, vec4(p, 1.0f)), dot(i.row2, vec4(p, 1.0f)));
}

size_t instanced_triangles(const Scene& scene) {
  size_t count = 0;
  for (const Instance& instance : scene.instances) count += scene.meshes[size_t(instance.mesh)].triangle_count;
  return count;
}

// --- geometry

TEST(Gltf, ATriangleWithoutNormalsIsFlat) {
  const Scene scene = make_triangle().load();
  ASSERT_EQ(scene.triangles.size(), 1u);
  ASSERT_EQ(scene.vertices.size(), 3u);
  expect_near(scene.vertices[1].position, vec3(1, 0, 0));
  for (const Vertex& vertex : scene.vertices) expect_near(vertex.normal, vec3(0, 0, 1));
  EXPECT_EQ(scene.vertices[0].color, vec4(1.0f));
  EXPECT_EQ(scene.name, "test");
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(Gltf, FlatNormalsDoNotShareVertices) {
  GltfBuilder file = make_triangle();  // two faces at right angles over one edge
  file.primitive()["attributes"]["POSITION"] = file.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, kFloat, "VEC3");
  file.primitive()["indices"] = file.add<uint16_t>({0, 1, 2, 0, 2, 3}, kUshort, "SCALAR");
  const Scene scene = file.load();
  ASSERT_EQ(scene.vertices.size(), 6u);
  expect_near(scene.vertices[0].normal, vec3(0, 0, 1));
  expect_near(scene.vertices[3].normal, vec3(1, 0, 0));
}

TEST(Gltf, StripsAndFansKeepTheirSide) {
  for (const int mode : {5, 6}) {
    GltfBuilder file = make_triangle();
    const std::vector<float> strip = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    const std::vector<float> fan = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    file.primitive()["attributes"]["POSITION"] = file.add(mode == 5 ? strip : fan, kFloat, "VEC3");
    file.primitive()["mode"] = mode;
    const Scene scene = file.load();
    ASSERT_EQ(scene.triangles.size(), 2u);
    for (const Vertex& vertex : scene.vertices) expect_near(vertex.normal, vec3(0, 0, 1));
  }
}

TEST(Gltf, EveryTypeOfIndex) {
  for (const int type : {kUbyte, kUshort, kUint}) {
    GltfBuilder file = make_triangle();
    const int indices = type == kUbyte    ? file.add<uint8_t>({2, 0, 1}, type, "SCALAR")
                        : type == kUshort ? file.add<uint16_t>({2, 0, 1}, type, "SCALAR")
                                          : file.add<uint32_t>({2, 0, 1}, type, "SCALAR");
    file.primitive()["indices"] = indices;
    file.primitive()["attributes"]["NORMAL"] = file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, kFloat, "VEC3");
    EXPECT_EQ(file.load().triangles.at(0), uvec3(2, 0, 1));
  }
}

template <class T>
float loaded_color(T value, int type) {
  GltfBuilder file = make_triangle();
  const int accessor = file.add<T>({value, 0, 0, 0, value, 0, 0, 0, value, 0, 0, 0}, type, "VEC4");
  file.json["accessors"][static_cast<size_t>(accessor)]["normalized"] = type != kFloat;
  file.primitive()["attributes"]["COLOR_0"] = accessor;
  return file.load().vertices.at(0).color.x;
}

TEST(Gltf, EveryTypeOfColor) {
  EXPECT_FLOAT_EQ(loaded_color<float>(0.25f, kFloat), 0.25f);
  EXPECT_FLOAT_EQ(loaded_color<uint8_t>(51, kUbyte), 0.2f);
  EXPECT_FLOAT_EQ(loaded_color<uint16_t>(13107, kUshort), 0.2f);
  EXPECT_FLOAT_EQ(loaded_color<int8_t>(127, kByte), 1.0f);
  EXPECT_FLOAT_EQ(loaded_color<int16_t>(-32768, kShort), 0.0f);
}

TEST(Gltf, ColorOfThreeComponentsIsOpaque) {
  GltfBuilder file = make_triangle();
  file.primitive()["attributes"]["COLOR_0"] = file.add<float>({.1f, .2f, .3f, 1, 1, 1, 1, 1, 1}, kFloat, "VEC3");
  EXPECT_EQ(file.load().vertices[0].color, vec4(.1f, .2f, .3f, 1.0f));
}

TEST(Gltf, QuantizedMesh) {
  GltfBuilder file = make_triangle();
  file.json["extensionsRequired"] = file.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  auto& attributes = file.primitive()["attributes"];
  attributes["POSITION"] = file.add<int16_t>({0, 0, 0, 0, 300, 0, 0, 0, 0, -200, 0, 0}, kShort, "VEC4");
  auto& accessor = file.json["accessors"].back();
  accessor["type"] = "VEC3";  // padded to four bytes: the stride of the buffer view
  file.json["bufferViews"].back()["byteStride"] = 8;
  attributes["NORMAL"] = file.add<int8_t>({0, 0, -127, 0, 0, 0, -127, 0, 0, 0, -127, 0}, kByte, "VEC4");
  file.json["accessors"].back()["normalized"] = true;
  const Scene scene = file.load();
  expect_near(scene.vertices[1].position, vec3(300, 0, 0));
  expect_near(scene.vertices[2].position, vec3(0, -200, 0));
  expect_near(scene.vertices[0].normal, vec3(0, 0, -1));
}

TEST(Gltf, SparseAccessor) {
  GltfBuilder file = make_triangle();
  const int values = file.add<float>({5, 6, 7}, kFloat, "VEC3");
  const int indices = file.add<uint8_t>({1}, kUbyte, "SCALAR");
  file.json["accessors"][0]["sparse"] = {{"count", 1},
                                         {"indices", {{"bufferView", indices}, {"componentType", kUbyte}}},
                                         {"values", {{"bufferView", values}}}};
  const Scene scene = file.load();
  expect_near(scene.vertices[1].position, vec3(5, 6, 7));
  expect_near(scene.vertices[2].position, vec3(0, 1, 0));
}

// Integers of 32 bits do not fit into floats: 16777217 would become 16777216.
TEST(Gltf, SparseIndicesAreExact) {
  GltfBuilder file = make_triangle();
  const int where = file.add<uint8_t>({0, 1, 2}, kUbyte, "SCALAR");
  const int corners = file.add<uint32_t>({0, 1, 16777217}, kUint, "SCALAR");
  file.primitive()["indices"] = file.add<uint32_t>({0, 0, 0}, kUint, "SCALAR");
  file.json["accessors"].back()["sparse"] = {{"count", 3},
                                             {"indices", {{"bufferView", where}, {"componentType", kUbyte}}},
                                             {"values", {{"bufferView", corners}}}};
  EXPECT_NE(error_of(file.glb()).find("has the index 16777217,"), std::string::npos) << error_of(file.glb());
}

TEST(Gltf, TextureCoordinatesAreCutAtOnePlace) {
  GltfBuilder file = make_triangle();
  file.primitive()["material"] = 0;
  file.primitive()["attributes"]["TEXCOORD_0"] = file.add<float>({5e5f, -5e5f, 2e6f, -2e6f, 0, 0}, kFloat, "VEC2");
  file.json["images"] = {{{"bufferView", file.add_view(small_png())}, {"mimeType", "image/png"}}};
  file.json["textures"] = GltfJson::parse(R"([{"source": 0}])");
  file.json["materials"] = GltfJson::parse(R"([{"emissiveTexture": {"index": 0, "extensions": {"KHR_texture_transform":
      {"offset": [5e5, -2e6], "scale": [-5e5, 2e6]}}}}])");
  const Scene scene = file.load();
  EXPECT_EQ(scene.vertices[0].uv0, vec2(5e5f, -5e5f));
  EXPECT_EQ(scene.vertices[1].uv0, vec2(1e6f, -1e6f));
  const TextureSlot& slot = scene.materials[0].emission_slot;
  EXPECT_EQ(slot.offset, vec2(5e5f, -1e6f));
  EXPECT_EQ(slot.axis_u.x, -5e5f);
  EXPECT_EQ(slot.axis_v.y, 1e6f);
}

TEST(Gltf, InterleavedAttributes) {
  GltfBuilder file = make_triangle();
  const int positions = file.add<float>({0, 0, 0, .1f, .2f, 1, 0, 0, .3f, .4f, 0, 1, 0, .5f, .6f, 0}, kFloat, "SCALAR");
  file.json["bufferViews"].back()["byteStride"] = 20;
  GltfJson& accessors = file.json["accessors"];
  accessors.back() = {{"bufferView", positions}, {"componentType", kFloat}, {"count", 3}, {"type", "VEC3"}};
  accessors.push_back(
      {{"bufferView", positions}, {"byteOffset", 12}, {"componentType", kFloat}, {"count", 3}, {"type", "VEC2"}});
  file.primitive()["attributes"] = {{"POSITION", 1}, {"TEXCOORD_0", 2}, {"TEXCOORD_1", 2}};
  const Scene scene = file.load();
  expect_near(scene.vertices[2].position, vec3(0, 1, 0));
  EXPECT_EQ(scene.vertices[1].uv0, vec2(.3f, .4f));
  EXPECT_EQ(scene.vertices[2].uv1, vec2(.5f, .6f));
}

TEST(Gltf, VerticesThatNoTriangleUsesAreLeftOut) {
  GltfBuilder file = make_triangle();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  file.primitive()["attributes"]["POSITION"] =
      file.add<float>({nan, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, nan, 0, 0}, kFloat, "VEC3");
  file.primitive()["indices"] = file.add<uint8_t>({1, 2, 3}, kUbyte, "SCALAR");
  const Scene scene = file.load();
  EXPECT_EQ(scene.vertices.size(), 3u);
  EXPECT_TRUE(scene.warnings.empty());
}

// --- tangents

// A square in the z = 0 plane whose picture stands upright (u to the right, v down), optionally mirrored.
Scene normal_mapped_square(bool mirrored) {
  GltfBuilder file = make_triangle();
  auto& attributes = file.primitive()["attributes"];
  attributes["POSITION"] = file.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, kFloat, "VEC3");
  attributes["NORMAL"] = file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, kFloat, "VEC3");
  const float left = mirrored ? 1.0f : 0.0f, right = 1.0f - left;
  attributes["TEXCOORD_0"] = file.add<float>({left, 1, right, 1, right, 0, left, 0}, kFloat, "VEC2");
  file.primitive()["indices"] = file.add<uint8_t>({0, 1, 2, 0, 2, 3}, kUbyte, "SCALAR");
  file.primitive()["material"] = 0;
  file.json["images"] = {{{"bufferView", file.add_view(small_png())}, {"mimeType", "image/png"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
  return file.load();
}

TEST(Gltf, TangentsFollowTheTexture) {
  for (const Vertex& vertex : normal_mapped_square(false).vertices) EXPECT_EQ(vertex.tangent, vec4(1, 0, 0, 1));
  // cross(normal, tangent) * w is +Y in both: up in the picture.
  for (const Vertex& vertex : normal_mapped_square(true).vertices) EXPECT_EQ(vertex.tangent, vec4(-1, 0, 0, -1));
}

// --- nodes

TEST(Gltf, HierarchyOfMatrixAndTrs) {
  GltfBuilder file = make_triangle();
  file.json["nodes"] = GltfJson::parse(R"([
      {"children": [1], "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 10,20,30,1]},
      {"mesh": 0, "translation": [1,2,3], "rotation": [0,0,0.70710678,0.70710678], "scale": [2,3,4]}])");
  const Scene scene = file.load();
  ASSERT_EQ(scene.instances.size(), 1u);
  expect_near(world_of(scene, 0, vec3(0, 0, 0)), vec3(11, 22, 33));
  expect_near(world_of(scene, 0, vec3(1, 0, 0)), vec3(11, 24, 33));  // x turned to y, twice as long
  expect_near(world_of(scene, 0, vec3(0, 1, 0)), vec3(8, 22, 33));
}

TEST(Gltf, SharedMeshIsStoredOnce) {
  GltfBuilder file = make_triangle();
  file.json["scenes"][0]["nodes"] = {0, 1, 2};
  file.json["nodes"] =
      GltfJson::parse(R"([{"mesh": 0}, {"mesh": 0, "translation": [1,0,0]}, {"mesh": 0, "scale": [2,2,2]}])");
  const Scene scene = file.load();
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.instances.size(), 3u);
}

TEST(Gltf, GpuInstancing) {
  GltfBuilder file = make_triangle();
  const int where = file.add<float>({1, 0, 0, 2, 0, 0}, kFloat, "VEC3");
  const int turned = file.add<int8_t>({0, 0, 0, 127, 0, 0, 127, 0}, kByte, "VEC4");
  file.json["accessors"].back()["normalized"] = true;
  file.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  file.node(0)["translation"] = {0, 5, 0};
  file.node(0)["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", where}, {"ROTATION", turned}};
  const Scene scene = file.load();
  ASSERT_EQ(scene.instances.size(), 2u);
  expect_near(world_of(scene, 0, vec3(1, 0, 0)), vec3(2, 5, 0));
  expect_near(world_of(scene, 1, vec3(1, 0, 0)), vec3(1, 5, 0));  // half a turn about z
}

TEST(Gltf, SeveralScenes) {
  GltfBuilder file = make_triangle();
  file.json["scenes"] = GltfJson::parse(R"([{"nodes": [0]}, {"nodes": [0, 1]}, {}])");
  file.json["nodes"] = GltfJson::parse(R"([{"mesh": 0}, {"mesh": 0, "translation": [1,0,0]}])");
  file.json["scene"] = 1;
  EXPECT_EQ(file.load().instances.size(), 2u);
  EXPECT_EQ(file.load({.scene = 0}).instances.size(), 1u);
  EXPECT_EQ(file.load({.scene = 2}).instances.size(), 0u);
  EXPECT_THROW(file.load({.scene = 3}), Error);
}

TEST(Gltf, CamerasComeBackAsTheyWereSet) {
  for (const vec3 angles :
       {vec3(0, 0, 0), vec3(30, 20, 10), vec3(-120, -60, 45), vec3(170, 5, -170), vec3(40, 90, 0)}) {
    StereoCamera stereo;
    stereo.yaw = angles.x;
    stereo.pitch = angles.y;
    stereo.roll = angles.z;
    const Camera camera = make_camera(stereo);
    GltfBuilder file = make_triangle();
    file.json["cameras"] = GltfJson::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
    const vec3 x = 2.0f * camera.right, y = 2.0f * camera.up, z = 2.0f * camera.back;
    file.json["nodes"] = {{{"camera", 0},
                           {"name", "door"},
                           {"matrix", {x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, 1, 2, 3, 1}}}};
    const Scene scene = file.load();
    ASSERT_EQ(scene.view_points.size(), 1u);
    const ViewPoint& view = scene.view_points[0];
    EXPECT_EQ(view.name, "door");
    expect_near(view.position, vec3(1, 2, 3));
    EXPECT_NEAR(view.yaw, angles.x, 2e-3);
    EXPECT_NEAR(view.pitch, angles.y, 2e-2);
    EXPECT_NEAR(view.roll, angles.z, 2e-3);
  }
}

// --- materials

TEST(Gltf, AlbedoScales) {
  for (const auto& [scale, expected] : {std::pair{1.25, 0.5f}, std::pair{-1.0, 0.0f}, std::pair{7.0, 0.8f}}) {
    GltfBuilder file = make_triangle();
    file.json["extensionsUsed"] = {"ODS_albedo"};
    file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.4, 0.4, 0.4, 0.5}}}},
                               {"extensions", {{"ODS_albedo", {{"scale", scale}}}}}}};
    file.primitive()["material"] = 0;
    const Scene scene = file.load();
    EXPECT_FLOAT_EQ(scene.materials[0].base_color.x, expected);
    EXPECT_EQ(scene.materials[0].base_color.w, 0.5f);
  }
}

TEST(Gltf, DefaultMaterialIsGltfs) {
  const Scene scene = make_triangle().load();
  const Material& material = scene.materials[size_t(scene.meshes[0].material)];
  EXPECT_EQ(material.metallic, 1.0f);
  EXPECT_EQ(material.roughness, 1.0f);
  EXPECT_EQ(material.double_sided, 0);
  EXPECT_EQ(material.base_color, vec4(1.0f));
}

TEST(Gltf, EveryFactorOfAMaterial) {
  GltfBuilder file = make_triangle();
  file.primitive()["material"] = 0;
  file.json["materials"] = GltfJson::parse(R"([{
      "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.6},
      "emissiveFactor": [1, 0.5, 0], "alphaMode": "MASK", "alphaCutoff": 0.7, "doubleSided": true,
      "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}, "KHR_materials_unlit": {},
                     "KHR_materials_ior": {"ior": 1.33}, "KHR_materials_transmission": {"transmissionFactor": 0.9},
                     "KHR_materials_volume": {"thicknessFactor": 0.01, "attenuationDistance": 2,
                                              "attenuationColor": [0.5, 1, 1]}}}])");
  const Material material = file.load().materials[0];
  EXPECT_EQ(material.base_color, vec4(.1f, .2f, .3f, .4f));
  EXPECT_EQ(material.metallic, .5f);
  EXPECT_EQ(material.roughness, .6f);
  expect_near(material.emission, vec3(8, 4, 0));
  EXPECT_EQ(material.alpha_mode, kAlphaMask);
  EXPECT_EQ(material.alpha_cutoff, .7f);
  EXPECT_EQ(material.double_sided, 1);
  EXPECT_EQ(material.unlit, 1);
  EXPECT_EQ(material.ior, 1.33f);
  EXPECT_EQ(material.transmission, .9f);
  EXPECT_EQ(material.thickness, .01f);
  EXPECT_EQ(material.attenuation_distance, 2.0f);
  expect_near(material.attenuation_color, vec3(.5f, 1, 1));
}

TEST(Gltf, AScenesReachIsWarnedOf) {
  GltfBuilder file = make_triangle();
  file.json["nodes"].push_back(file.json["nodes"][0]);
  file.json["scenes"][0]["nodes"] = {0, 1};
  file.json["nodes"][1]["translation"] = {0, 0, -2999};
  EXPECT_TRUE(file.load().warnings.empty());
  file.json["nodes"][1]["translation"] = {0, 0, -6000};
  ASSERT_EQ(file.load().warnings.size(), 1u);
  EXPECT_NE(file.load().warnings.at(0).find("6 km"), std::string::npos);
}

// KHR_materials_ior: 0 asks for a Fresnel term of 1.
TEST(Gltf, IndexOfRefractionZeroIsAMirror) {
  GltfBuilder file = make_triangle();
  file.json["materials"] = GltfJson::parse(R"([{"extensions": {"KHR_materials_ior": {"ior": 0}}},
      {"extensions": {"KHR_materials_ior": {"ior": 0.5}}},
      {"extensions": {"KHR_materials_ior": {"ior": 0}, "KHR_materials_specular": {"specularFactor": 0.1}}}])");
  const Scene scene = file.load();
  const float ior = scene.materials[0].ior;
  EXPECT_EQ((ior - 1.0f) / (ior + 1.0f), 1.0f);
  EXPECT_EQ(fresnel_dielectric(0.7f, ior), 1.0f);
  EXPECT_EQ(scene.materials[1].ior, 1.5f);
  EXPECT_EQ(scene.materials[2].ior, ior);
  ASSERT_EQ(scene.materials[2].layers, 0);
  EXPECT_EQ(scene.material_layers[0].specular, 0.1f);
  EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(Gltf, TexturesAndTheirSamplers) {
  GltfBuilder file = make_triangle();
  file.primitive()["material"] = 0;
  file.json["images"] = {{{"bufferView", file.add_view(small_png())}, {"mimeType", "image/png"}}};
  file.json["samplers"] = GltfJson::parse(R"([{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}])");
  file.json["textures"] = GltfJson::parse(R"([{"source": 0, "sampler": 0}, {"source": 0}])");
  file.json["materials"] = GltfJson::parse(R"([{
      "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}, "metallicRoughnessTexture": {"index": 0}},
      "emissiveTexture": {"index": 1, "extensions": {"KHR_texture_transform":
          {"offset": [0, 1], "rotation": 1.5707963267948966, "scale": [0.5, 0.5]}}}}])");
  const Scene scene = file.load();
  const Material& material = scene.materials[0];
  const Texture& base = scene.textures.at(size_t(material.base_color_slot.texture));
  const Texture& rough = scene.textures.at(size_t(material.metallic_roughness_slot.texture));
  EXPECT_EQ(material.base_color_slot.uv_set, 1);
  EXPECT_EQ(base.wrap_u, kWrapClamp);
  EXPECT_EQ(base.wrap_v, kWrapMirror);
  EXPECT_EQ(base.nearest, 1);
  EXPECT_EQ(base.srgb, 1);
  EXPECT_EQ(rough.srgb, 0);
  EXPECT_EQ(base.first_texel, rough.first_texel);
  EXPECT_EQ(scene.texels, std::vector<uint>(4, 0xff0080ffu));  // stored once for the three of them
  // The first example of KHR_texture_transform: the lower left quarter of the picture, turned clockwise.
  const TextureSlot& slot = material.emission_slot;
  const vec2 corner = slot.offset + slot.axis_u, other = slot.offset + slot.axis_v;
  EXPECT_NEAR(glm::distance(corner, vec2(0.0f, 0.5f)), 0.0f, 1e-6f);
  EXPECT_NEAR(glm::distance(other, vec2(0.5f, 1.0f)), 0.0f, 1e-6f);
}

// --- extensions

TEST(Gltf, ExtensionsThatAreNotRendered) {
  GltfBuilder file = make_triangle();
  file.json["extensionsUsed"] = {"KHR_materials_other", "KHR_materials_other", "VENDOR_thing", "KHR_materials_ior"};
  const Scene scene = file.load();
  ASSERT_EQ(scene.warnings.size(), 2u);
  EXPECT_NE(scene.warnings[0].find("KHR_materials_other"), std::string::npos);
  EXPECT_NE(scene.warnings[1].find("VENDOR_thing"), std::string::npos);
}

TEST(Gltf, RequiredExtensionsAreNamed) {
  GltfBuilder file = make_triangle();
  file.json["extensionsRequired"] = {"VENDOR_thing"};
  const std::string error = error_of(file.glb());
  EXPECT_NE(error.find("VENDOR_thing"), std::string::npos) << error;
  EXPECT_NE(error.find("export it again without"), std::string::npos) << error;
}

// --- files

TEST(Gltf, BuffersAndPicturesBesideTheFile) {
  const TemporaryFolder holder;
  const std::filesystem::path folder = holder.path("a b");
  std::filesystem::create_directory(folder);
  GltfBuilder file = make_triangle();
  auto write = [&](const std::string& name, const Binary& bytes) {
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  };
  file.json["buffers"] = {{{"uri", "my%20data.bin"}, {"byteLength", file.binary.size()}}};
  file.json["images"] = GltfJson::parse(R"([{"uri": "tile.png"}])");
  file.json["textures"] = GltfJson::parse(R"([{"source": 0}])");
  file.json["materials"] = GltfJson::parse(R"([{"emissiveTexture": {"index": 0}}])");
  write("my data.bin", file.binary);
  write("tile.png", small_png());
  std::ofstream(folder / "scene.gltf") << file.json.dump();
  const Scene scene = load_gltf((folder / "scene.gltf").string());
  EXPECT_EQ(scene.triangles.size(), 1u);
  EXPECT_EQ(scene.texels.size(), 4u);
  EXPECT_EQ(scene.name, "scene");
  std::filesystem::remove(folder / "tile.png");
  EXPECT_THROW(load_gltf((folder / "scene.gltf").string()), Error);
}

TEST(Gltf, BufferInADataUri) {
  GltfBuilder file = make_triangle();  // nine floats: 0 0 0 1 0 0 0 1 0
  const std::string uri = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  file.json["buffers"] = {{{"uri", uri}, {"byteLength", 36}}};
  const std::string text = file.json.dump();
  const Scene scene = load_gltf_bytes(Binary(text.begin(), text.end()), "test.gltf");
  expect_near(scene.vertices.at(1).position, vec3(1, 0, 0));
  expect_near(scene.vertices.at(2).position, vec3(0, 1, 0));
}

TEST(Gltf, SharedScenes) {
  const std::filesystem::path folder = shared_scenes();
  if (!std::filesystem::exists(folder / "atrium.glb"))
    GTEST_SKIP() << "skipped: no ../shared/scenes beside the sources";
  const Scene atrium = load_gltf((folder / "atrium.glb").string());
  EXPECT_EQ(broken_promise(atrium), "");
  EXPECT_EQ(instanced_triangles(atrium), 836494u);
  EXPECT_EQ(atrium.instances.size(), 1547u);
  const Scene helmet = load_gltf((folder / "DamagedHelmet.glb").string());
  EXPECT_EQ(broken_promise(helmet), "");
  EXPECT_EQ(instanced_triangles(helmet), 15452u);
}

}  // namespace ods::gltf_test
