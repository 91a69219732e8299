// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The use of a file's pictures: normal maps of 16 bits, and cube maps that light the scene.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "ods/kernel/camera/projection.h"
#include "ods/kernel/texture.h"
#include "ods/scene/reduced_textures.h"
#include "tests/support/png_files.h"

namespace ods {
namespace {

// --- normal maps

// A shallow bowl: the normal's x and y run from -0.02 to 0.02. 0..1, as files have it.
vec3 bowl(int x, int y, int size) {
  const vec2 slope = (vec2(x, y) / static_cast<float>(size - 1) - 0.5f) * 0.04f;
  return vec3(slope, std::sqrt(1.0f - glm::dot(slope, slope))) * 0.5f + 0.5f;
}

Scene normal_mapped(SampleType sample, int size) {
  GltfBuilder file = make_triangle();
  const Binary png = make_png(size, size, "RGB", sample, [&](int x, int y, int c) { return bowl(x, y, size)[c]; });
  const int texture = add_texture(file, png);
  file.json["materials"] = {{{"normalTexture", {{"index", texture}}}, {"emissiveTexture", {{"index", texture}}}}};
  file.primitive()["material"] = 0;
  return file.load();
}

// Each of the texture's vectors, in units of the normal.
std::vector<vec3> normals_of(const Scene& scene, const Texture& texture) {
  TextureReader reader;
  reader.texels = scene.texels.data();
  std::vector<vec3> normals;
  for (int i = 0; i < texture.width * texture.height; i++) {
    const vec4 texel = reader.texel_at(texture, false, i % texture.width, i / texture.width);
    normals.push_back(normalize(vec3(texel) * 2.0f - 1.0f));
  }
  return normals;
}

TEST(NormalMaps, SixteenBitsAreKept) {
  constexpr int kSize = 64;
  const auto worst_angle = [&](SampleType sample) {
    const Scene scene = normal_mapped(sample, kSize);
    const Texture& texture = scene.textures.at(size_t(scene.materials[0].normal_slot.texture));
    EXPECT_EQ(texture.packing, sample == SampleType::kUint16 ? kTexelNormal : kTexelBytes);
    const std::vector<vec3> normals = normals_of(scene, texture);
    double worst = 0.0;
    for (int i = 0; i < kSize * kSize; i++) {
      const glm::dvec3 truth = normalize(glm::dvec3(bowl(i % kSize, i / kSize, kSize) * 2.0f - 1.0f));
      worst = std::max(worst, glm::length(glm::dvec3(normals[size_t(i)]) - truth));
    }
    return glm::degrees(worst);
  };
  EXPECT_LT(worst_angle(SampleType::kUint16), 0.003);
  EXPECT_GT(worst_angle(SampleType::kUint8), 0.2) << "what eight bits can hold";
}

// The same picture in another role has bytes.
TEST(NormalMaps, OtherRolesOfThePictureHaveBytes) {
  const Scene scene = normal_mapped(SampleType::kUint16, 8);
  const Texture& glow = scene.textures.at(size_t(scene.materials[0].emission_slot.texture));
  EXPECT_EQ(glow.packing, kTexelBytes);
  EXPECT_EQ(scene.texels.size(), 2u * 64u);
  EXPECT_EQ(scene.texels[glow.first_texel] & 255u, 125u);  // 255 * 0.49
}

TEST(NormalMaps, ReducedOnesAreMeanDirections) {
  Scene scene = normal_mapped(SampleType::kUint16, 512);
  reduce_textures(scene);
  const auto which = size_t(scene.materials[0].normal_slot.texture);
  const Texture &full = scene.textures[which], &reduced = scene.reduced_textures[which];
  ASSERT_EQ(reduced.packing, kTexelNormal);
  ASSERT_EQ(reduced.width, 256);
  const uint* from = scene.texels.data() + full.first_texel;
  const auto normal = [](uint bits) { return vec3(unpack_normal(bits)) * 2.0f - 1.0f; };
  for (int y = 0; y < reduced.height; y += 37) {
    for (int x = 0; x < reduced.width; x += 41) {
      vec3 mean(0.0f);
      for (int i = 0; i < 4; i++) mean += normal(from[(2 * y + i / 2) * full.width + 2 * x + i % 2]);
      const vec3 found = normal(scene.reduced_texels[reduced.first_texel + uint(y * reduced.width + x)]);
      EXPECT_LT(glm::length(found - normalize(mean)), 5e-5f);
    }
  }
}

// Any direction in front of the surface survives packing; a steep one loses the most, as its z comes from x and y.
TEST(NormalMaps, PackingKeepsDirections) {
  for (int i = 0; i < 1000; i++) {
    const float z = static_cast<float>(i % 97) / 96.0f, turn = static_cast<float>(i);
    const float r = std::sqrt(1.0f - z * z);
    const vec3 n(r * std::cos(turn), r * std::sin(turn), z);
    const vec3 found = vec3(unpack_normal(pack_normal(n * 3.0f))) * 2.0f - 1.0f;
    EXPECT_LT(glm::length(found - n), z > 0.1f ? 3e-4f : 8e-3f) << z;
  }
  EXPECT_EQ(unpack_normal(pack_normal(vec3(0.0f))).z, 1.0f);
}

// --- KHR_materials_pbrSpecularGlossiness

GltfBuilder make_older(const char* material) {
  GltfBuilder file = make_triangle();
  file.json["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
  file.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = GltfJson::parse(material);
  file.primitive()["material"] = 0;
  return file;
}

TEST(SpecularGlossiness, Factors) {
  const Scene scene = make_older(R"({"diffuseFactor": [0.1, 0.2, 0.3, 0.4], "specularFactor": [0.9, 0.8, 0.7],
                                     "glossinessFactor": 0.75})")
                          .load();
  const Material& material = scene.materials[0];
  EXPECT_EQ(material.base_color, vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(material.metallic, 0.0f);
  EXPECT_EQ(material.roughness, 0.25f);
  ASSERT_NE(material.layers, -1);
  EXPECT_EQ(scene.material_layers[size_t(material.layers)].specular_color, vec3(0.9f, 0.8f, 0.7f));
  const float root = (material.ior - 1.0f) / (material.ior + 1.0f);
  EXPECT_EQ(root * root, 1.0f) << "the specular colour alone decides on the reflectance";
  EXPECT_TRUE(scene.warnings.empty());
}

// A material of both kinds is of this one.
TEST(SpecularGlossiness, ItsDefaultsAreAMirror) {
  GltfBuilder file = make_older("{}");
  file.json["materials"][0]["pbrMetallicRoughness"] = {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 1}};
  const Scene scene = file.load();
  EXPECT_EQ(scene.materials[0].base_color, vec4(1.0f));
  EXPECT_EQ(scene.materials[0].metallic, 0.0f);
  EXPECT_EQ(scene.materials[0].roughness, 0.0f);
}

TEST(SpecularGlossiness, TheTextureIsSplit) {
  GltfBuilder file = make_older(R"({"glossinessFactor": 0.5, "specularFactor": [1, 1, 0.5]})");
  // 200 and 100 of red and green, glossiness from 0 to 1.
  const int texture = add_texture(file, make_png(6, 1, "RGBA", SampleType::kUint8, [](int x, int, int c) {
                                    const float codes[] = {200.0f / 255.0f, 100.0f / 255.0f, 1.0f};
                                    return c == 3 ? static_cast<float>(x) * 0.2f : codes[c];
                                  }));
  const int diffuse = add_texture(file, small_png());
  GltfJson& older = file.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"];
  older["specularGlossinessTexture"] = {{"index", texture}};
  older["diffuseTexture"] = {{"index", diffuse}};
  const Scene scene = file.load();
  const Material& material = scene.materials[0];
  EXPECT_EQ(material.roughness, 1.0f);
  TextureReader reader;
  reader.texels = scene.texels.data();
  const Texture& rough = scene.textures.at(size_t(material.metallic_roughness_slot.texture));
  for (int x = 0; x < 6; x++) {
    const float glossiness = 0.5f * static_cast<float>(x) * 0.2f;
    EXPECT_NEAR(reader.texel_at(rough, false, x, 0).y, 1.0f - glossiness, 0.5f / 255.0f + 1e-6f) << x;
  }
  const MaterialLayers& layers = scene.material_layers.at(size_t(material.layers));
  const Texture& specular = scene.textures.at(size_t(layers.specular_color_slot.texture));
  EXPECT_EQ(specular.srgb, 1);
  EXPECT_EQ(scene.texels[specular.first_texel + 3] & 0xffffffu, 0xff64c8u);
  EXPECT_EQ(scene.textures.at(size_t(material.base_color_slot.texture)).srgb, 1);
}

// --- EXT_lights_image_based

// A cube map of 4x4 texels per face: color(face, x, y) are code values 0..1.
GltfBuilder make_lit(const std::string& channels, const std::function<vec4(int face, int x, int y)>& color) {
  GltfBuilder file = make_triangle();
  file.json["extensionsUsed"] = {"EXT_lights_image_based"};
  GltfJson faces = GltfJson::array();
  for (int face = 0; face < 6; face++) {
    const Binary png =
        make_png(4, 4, channels, SampleType::kUint8, [&](int x, int y, int c) { return color(face, x, y)[c]; });
    add_texture(file, png);
    faces.push_back(face);
  }
  GltfJson& light = file.json["extensions"]["EXT_lights_image_based"]["lights"][0];
  light["specularImages"] = {faces, faces};
  light["specularImageSize"] = 4;
  file.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
  return file;
}

vec3 light_from(const Scene& scene, vec3 direction) {
  const Environment& sky = scene.environment;
  const vec2 uv = direction_to_lat_long(direction);
  const int x = std::min(int(uv.x * float(sky.width)), sky.width - 1);
  const int y = std::min(int(uv.y * float(sky.height)), sky.height - 1);
  return sky.radiance * sky.texels.at(size_t(y * sky.width + x));
}

void expect_near(vec3 actual, vec3 expected, float tolerance) {
  for (int c = 0; c < 3; c++) EXPECT_NEAR(actual[c], expected[c], tolerance) << "component " << c;
}

const vec3 kAxes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

// Each face has one of red, green and blue at full, faces of negative axes another at full as well.
vec4 face_color(int face) {
  vec4 color(0, 0, 0, 1);
  color[face / 2] = 1.0f;
  if (face % 2 == 1) color[(face / 2 + 1) % 3] = 1.0f;
  return color;
}

TEST(ImageLights, EveryFaceIsInItsDirection) {
  const Scene scene = make_lit("RGB", [](int face, int, int) { return face_color(face); }).load();
  EXPECT_EQ(scene.environment.width, 16);
  EXPECT_EQ(scene.environment.height, 8);
  for (int face = 0; face < 6; face++) expect_near(light_from(scene, kAxes[face]), vec3(face_color(face)), 0.0f);
  EXPECT_TRUE(has_light(scene));
  EXPECT_TRUE(scene.warnings.empty());
}

// Within a face, as OpenGL has it: on +Z x runs to the right and y upwards, on -Z x runs to the left, on +X z.
TEST(ImageLights, FacesAreTurnedAsInOpenGl) {
  const auto right_is_bright = [](int, int x, int) { return vec4(x < 2 ? 0.0f : 1.0f); };
  const Scene sides = make_lit("RGB", right_is_bright).load();
  EXPECT_GT(light_from(sides, vec3(0.7f, 0, 1)).x, 0.9f);
  EXPECT_LT(light_from(sides, vec3(-0.7f, 0, 1)).x, 0.1f);
  EXPECT_GT(light_from(sides, vec3(-0.7f, 0, -1)).x, 0.9f);
  EXPECT_LT(light_from(sides, vec3(0.7f, 0, -1)).x, 0.1f);
  EXPECT_GT(light_from(sides, vec3(1, 0, -0.7f)).x, 0.9f);
  EXPECT_GT(light_from(sides, vec3(-1, 0, 0.7f)).x, 0.9f);
  EXPECT_GT(light_from(sides, vec3(0.7f, 1, 0)).x, 0.9f);
  const auto top_is_bright = [](int, int, int y) { return vec4(y < 2 ? 1.0f : 0.0f); };
  const Scene heights = make_lit("RGB", top_is_bright).load();
  for (const int face : {0, 1, 4, 5}) {
    EXPECT_GT(light_from(heights, kAxes[face] + vec3(0, 0.7f, 0)).x, 0.9f);
    EXPECT_LT(light_from(heights, kAxes[face] - vec3(0, 0.7f, 0)).x, 0.1f);
  }
  EXPECT_GT(light_from(heights, vec3(0, 1, -0.7f)).x, 0.9f);
  EXPECT_GT(light_from(heights, vec3(0, -1, 0.7f)).x, 0.9f);
}

TEST(ImageLights, RotationAndIntensity) {
  GltfBuilder file = make_lit("RGB", [](int face, int, int) { return face_color(face); });
  GltfJson& light = file.json["extensions"]["EXT_lights_image_based"]["lights"][0];
  light["intensity"] = 2.5;
  const float s = std::sqrt(0.5f);
  light["rotation"] = {0, s, 0, s};  // a quarter turn about +Y: what was at +Z comes to +X, what was at +X to -Z
  const Scene scene = file.load();
  expect_near(light_from(scene, kAxes[0]), 2.5f * vec3(face_color(4)), 1e-5f);
  expect_near(light_from(scene, kAxes[5]), 2.5f * vec3(face_color(0)), 1e-5f);
  expect_near(light_from(scene, kAxes[2]), 2.5f * vec3(face_color(2)), 1e-5f);
}

TEST(ImageLights, AlphaDividesTheLight) {
  const auto color = [](int, int, int) { return vec4(1.0f, 128.0f / 255.0f, 0.0f, 51.0f / 255.0f); };
  const Scene scene = make_lit("RGBA", color).load();
  expect_near(light_from(scene, kAxes[0]), vec3(5.0f, 5.0f * 0.21586f, 0.0f), 1e-3f);
}

// The mean over the sphere of a cube map with one bright face is a sixth of it.
TEST(ImageLights, LightIsKept) {
  const Scene scene = make_lit("RGB", [](int face, int, int) { return vec4(face == 3 ? 1.0f : 0.0f); }).load();
  const Environment& sky = scene.environment;
  double sum = 0.0, all = 0.0;
  for (int y = 0; y < sky.height; y++) {
    const double weight = std::sin((y + 0.5) / sky.height * std::acos(-1.0));
    for (int x = 0; x < sky.width; x++) {
      sum += weight * static_cast<double>(sky.texels[size_t(y * sky.width + x)].x);
      all += weight;
    }
  }
  EXPECT_NEAR(sum / all, 1.0 / 6.0, 0.01);
}

TEST(ImageLights, OnlyTheSceneThatNamesIt) {
  GltfBuilder file = make_lit("RGB", [](int face, int, int) { return face_color(face); });
  file.json["scenes"].push_back({{"nodes", {0}}});
  EXPECT_EQ(file.load({.scene = 1}).environment.width, 0);
  EXPECT_EQ(file.load({.scene = 0}).environment.width, 16);
}

TEST(ImageLights, BadOnesAreNamed) {
  const GltfBuilder good = make_lit("RGB", [](int face, int, int) { return face_color(face); });
  const auto changed = [&](const std::function<void(GltfJson & light, GltfBuilder & file)>& change) {
    GltfBuilder file = good;
    change(file.json["extensions"]["EXT_lights_image_based"]["lights"][0], file);
    return error_of(file.glb());
  };
  EXPECT_EQ(changed([](GltfJson&, GltfBuilder&) {}), "");
  EXPECT_NE(changed([](GltfJson& light, GltfBuilder&) {
              light["specularImages"][0] = {0, 1, 2};
            }).find("six faces"),
            std::string::npos);
  EXPECT_NE(changed([](GltfJson& light, GltfBuilder&) { light["specularImages"][0][5] = 99; }).find("image 99"),
            std::string::npos);
  EXPECT_NE(changed([](GltfJson& light, GltfBuilder&) { light["specularImages"][0][5] = "x"; }).find("image -1"),
            std::string::npos);
  EXPECT_NE(changed([](GltfJson& light, GltfBuilder& file) {
              add_texture(file, small_png());
              light["specularImages"][0][5] = 6;
            }).find("squares of one size"),
            std::string::npos);
  EXPECT_NE(changed([](GltfJson&, GltfBuilder& file) {
              file.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 7;
            }).find("light 7"),
            std::string::npos);
  GltfBuilder empty = good;
  empty.json["extensions"]["EXT_lights_image_based"]["lights"][0].erase("specularImages");
  EXPECT_EQ(empty.load().warnings.size(), 1u);
}

}  // namespace
}  // namespace ods
