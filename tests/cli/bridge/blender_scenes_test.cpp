// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The scenes of blender_scenes.py as the bridge exports them, all in one Blender.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "ods/scene/load/load.h"
#include "ods/scene/motion.h"
#include "tests/support/places.h"
#include "tests/support/programs.h"
#include "tests/support/temporary_folder.h"

namespace ods::blender_scenes_test {

namespace fs = std::filesystem;

class BlenderScenes : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!missing("Blender", "blender --version").empty()) return;
    folder_ = std::make_unique<TemporaryFolder>();
    // A distribution's Blender needs the system's Python.
    const std::string root = source_folder();
    run_line("env PATH=/usr/bin:/bin:$PATH blender --background --factory-startup --python " + root +
             "/tests/cli/bridge/blender_scenes.py -- " + root + " " + folder_->path(""));
  }
  static void TearDownTestSuite() { folder_.reset(); }

  void SetUp() override {
    if (!folder_) GTEST_SKIP() << missing("Blender", "blender --version");
  }

  static std::string path(const std::string& scene, const char* file) { return folder_->path(scene + "/" + file); }

  static Scene load(const std::string& scene) {
    std::ifstream error(path(scene, "error"));
    EXPECT_FALSE(error) << std::string(std::istreambuf_iterator<char>(error), {});
    return load_scene(path(scene, "scene.glb"));
  }

  static nlohmann::json said(const std::string& scene) {
    std::ifstream file(path(scene, "bridge.json"));
    return nlohmann::json::parse(file, nullptr, false);
  }

  static std::string warnings(const std::string& scene) {
    const nlohmann::json file = said(scene);
    std::string all;
    for (const auto& line : file["warnings"]) all += line.get<std::string>() + "\n";
    return all;
  }

  static size_t index_of(const Scene& scene, const std::string& object) {
    for (const NamedObject& each : scene.objects) {
      if (each.name == object) return each.first_instance;
    }
    throw std::runtime_error(object);
  }

  static const Instance& instance_of(const Scene& scene, const std::string& object) {
    return scene.instances[index_of(scene, object)];
  }

  static bool is_hidden(const Scene& scene, size_t instance) {
    return instance < scene.hidden.size() && scene.hidden[instance] != 0;
  }

  static const Material& material_of(const Scene& scene, const std::string& object = "thing") {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance_of(scene, object).mesh)];
    return scene.materials[static_cast<size_t>(mesh.material)];
  }

  static vec3 place_of(const Instance& each) { return {each.row0.w, each.row1.w, each.row2.w}; }

  // The texel at a share of the picture from its left and its top: stored bytes.
  static std::array<uint32_t, 4> texel(const Scene& scene, const TextureSlot& slot, float x, float y) {
    EXPECT_GE(slot.texture, 0);
    if (slot.texture < 0) return {};
    const Texture& texture = scene.textures[static_cast<size_t>(slot.texture)];
    const auto column = static_cast<uint32_t>(x * static_cast<float>(texture.width));
    const auto row = static_cast<uint32_t>(y * static_cast<float>(texture.height));
    const uint32_t bits = scene.texels[texture.first_texel + row * static_cast<uint32_t>(texture.width) + column];
    return {bits & 255u, bits >> 8u & 255u, bits >> 16u & 255u, bits >> 24u};
  }

  static std::unique_ptr<TemporaryFolder> folder_;
};

std::unique_ptr<TemporaryFolder> BlenderScenes::folder_;

double linear(uint32_t code) {
  const double s = code / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

// Alpha: the half of what 0.25 of gloss leaves of the mask.
TEST_F(BlenderScenes, NestedMixesKeepTheirCutOut) {
  const Scene scene = load("nested_mixes");
  const Material& leaf = material_of(scene);
  EXPECT_EQ(leaf.alpha_mode, kAlphaBlend);
  const auto cut = texel(scene, leaf.base_color_slot, 0.2f, 0.5f);
  const auto whole = texel(scene, leaf.base_color_slot, 0.8f, 0.5f);
  EXPECT_NEAR(cut[3], 0.5 * 0.25 * 255, 2);
  EXPECT_NEAR(whole[3], 0.5 * 255, 2);
  EXPECT_NEAR(leaf.metallic, 0.25f, 1e-5f);
}

TEST_F(BlenderScenes, OnlyColorsThatAreReadCount) {
  const Scene used = load("used_colors"), unused = load("unused_colors");
  EXPECT_NEAR(material_of(used).base_color.x, 0.5f, 0.05f) << "the factor beside them, times albedo_scale()";
  EXPECT_NEAR(used.vertices[0].color.x, 0.5f, 0.01f);
  EXPECT_EQ(unused.vertices[0].color.x, 1.0f);
}

TEST_F(BlenderScenes, WhatTheUvMapComputesIsAPicture) {
  const Scene scene = load("mask");
  const Material& masked = material_of(scene);
  const auto left = texel(scene, masked.base_color_slot, 0.2f, 0.5f);
  const auto right = texel(scene, masked.base_color_slot, 0.8f, 0.5f);
  EXPECT_NEAR(linear(left[2]), 0.8, 0.01);
  EXPECT_NEAR(linear(left[0]), 0.05, 0.01);
  EXPECT_NEAR(linear(right[0]), 0.8, 0.01);
  EXPECT_NEAR(linear(right[2]), 0.05, 0.01);
  EXPECT_EQ(warnings("mask"), "");
}

TEST_F(BlenderScenes, AClippedPictureIsBlackAroundItself) {
  const Scene scene = load("decal");
  const TextureSlot& slot = material_of(scene).base_color_slot;
  EXPECT_EQ(texel(scene, slot, 0.5f, 0.5f)[0], 255u);
  for (const auto& [x, y] : {std::pair{0.2f, 0.5f}, {0.8f, 0.5f}, {0.5f, 0.2f}, {0.5f, 0.8f}}) {
    EXPECT_EQ(texel(scene, slot, x, y)[0], 0u) << x << ' ' << y;
  }
}

TEST_F(BlenderScenes, WhatRepeatsIsOneRepetition) {
  const Scene scene = load("tiles");
  const TextureSlot& slot = material_of(scene).base_color_slot;
  EXPECT_NEAR(linear(texel(scene, slot, 0.2f, 0.5f)[0]), 1.0, 0.01);
  EXPECT_NEAR(linear(texel(scene, slot, 0.8f, 0.5f)[0]), 0.25, 0.01);
  EXPECT_EQ(scene.textures[static_cast<size_t>(slot.texture)].width, 16);
  EXPECT_NEAR(slot.axis_u.x, 40.0f, 1e-3f);
}

TEST_F(BlenderScenes, WhatIsAMeanIsNamedOrBaked) {
  const Scene scene = load("boxes"), baked = load("boxes baked");
  const std::string lines = warnings("boxes");
  EXPECT_NE(lines.find("(Box projection): 5 materials 'box 0', 'box 1', 'box 2', 'box 3' and 1 more; --bake 1024"),
            std::string::npos)
      << lines;
  EXPECT_NE(lines.find("(Object coordinates): material 'along'"), std::string::npos) << lines;
  EXPECT_GT(material_of(scene, "thing 1").base_color.x, 0.2f);
  EXPECT_LT(material_of(scene, "thing 1").base_color.x, 0.8f);
  EXPECT_GE(material_of(baked, "thing 1").base_color_slot.texture, 0);
  EXPECT_EQ(warnings("boxes baked"), "");
}

TEST_F(BlenderScenes, NothingIsLostOfWhatIsTheSameAllOver) {
  const Scene scene = load("constant");
  const vec3 color(material_of(scene).base_color);  // times ODS_albedo
  EXPECT_NEAR(color.x, 0.4f, 0.04f);
  EXPECT_LT(length(color / color.x - vec3(1.0f, 0.5f, 0.25f)), 1e-3f);
  EXPECT_EQ(warnings("constant"), "");
}

// Cycles shows magenta; the exporter would fail.
TEST_F(BlenderScenes, APictureThatIsMissingIsMagenta) {
  const Scene scene = load("without_pictures");
  const Material& it = material_of(scene);
  EXPECT_LT(length(vec3(it.base_color) / it.base_color.x - vec3(1, 0, 1)), 1e-3f);
  EXPECT_LT(it.normal_slot.texture, 0);
  EXPECT_EQ(warnings("without_pictures"), "the picture '/nowhere/lost.png' cannot be found\n");
}

// The exporter would leave it out.
TEST_F(BlenderScenes, ComputedGlossIsAMean) {
  EXPECT_EQ(warnings("computed_gloss"), "a mean of what nodes compute (Specular): material 'it'\n");
  const Scene scene = load("computed_gloss");
  const int layers = material_of(scene).layers;
  ASSERT_GE(layers, 0);
  EXPECT_EQ(scene.material_layers[static_cast<size_t>(layers)].specular_color, vec3(0.0f));
}

// The picture's peak and the computed strength are the material's, the picture is their share.
TEST_F(BlenderScenes, EmissionMayBeBrighterThanOne) {
  const Scene scene = load("glow");
  const Material& glow = material_of(scene);
  EXPECT_NEAR(glow.emission.x, 8.0f, 0.05f);
  EXPECT_NEAR(linear(texel(scene, glow.emission_slot, 0.2f, 0.5f)[1]), 0.5, 0.01);
  EXPECT_NEAR(linear(texel(scene, glow.emission_slot, 0.8f, 0.5f)[0]), 0.25, 0.01);
}

// The value is a mean, or baked.
TEST_F(BlenderScenes, ComputedEmissionKeepsItsStrength) {
  EXPECT_LT(length(material_of(load("glow_along")).emission - vec3(4.0f, 2.0f, 1.0f)), 0.05f);
  const Scene scene = load("glow_along baked");
  const Material& baked = material_of(scene);
  EXPECT_NEAR(baked.emission.x, 4.0f, 0.05f);
  EXPECT_NEAR(linear(texel(scene, baked.emission_slot, 0.5f, 0.5f)[1]), 0.5, 0.02);
}

TEST_F(BlenderScenes, MaterialsOfLibrariesAndOverrides) {
  EXPECT_EQ(material_of(load("library")).metallic, 1.0f) << "its glossy shader";
  EXPECT_NEAR(material_of(load("override")).base_color.z, 0.3f, 0.03f) << "times albedo_scale()";
}

TEST_F(BlenderScenes, GeometryNodesChooseMaterials) {
  const Scene scene = load("nodes_material");
  EXPECT_EQ(warnings("nodes_material"), "");
  const vec3 color(material_of(scene).base_color);
  EXPECT_LT(color.x, 0.05f);
  EXPECT_GT(color.z, 0.9f);
}

TEST_F(BlenderScenes, ABackgroundSetIsThere) {
  const Scene scene = load("background_set");
  for (const char* name : {"thing", "wall", "chair"}) EXPECT_NO_THROW(index_of(scene, name)) << name;
  EXPECT_EQ(warnings("background_set"),
            "only the view layer 'ViewLayer' comes across, not 'second'\n"
            "the file has 2 scenes; this is 'Scene', --scene shows 'set'\n");
}

TEST_F(BlenderScenes, FogHasNoSurface) {
  EXPECT_EQ(material_of(load("fog")).base_color.w, 0.0f);
  EXPECT_NE(warnings("fog").find("the volume does not come across: material 'it'"), std::string::npos);
}

// Each by the name that Blender's panels give it.
TEST_F(BlenderScenes, SettingsWithoutCounterpartAreNamed) {
  const std::string lines = warnings("settings");
  for (const char* line :
       {"'Shadow Visibility' does not come across: object 'thing'",
        "of Principled BSDF does not come "
        "across: material 'skin'",
        "'Spread' does not come across: light 'narrow'", "'Shift X' does not come across: camera 'camera'",
        "'Exposure' does not come across: scene 'Scene'"}) {
    EXPECT_NE(lines.find(line), std::string::npos) << line << " is missing in\n" << lines;
  }
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 5) << lines;
  EXPECT_EQ(said("settings").value("shutter", 0.0), 180.0);
}

TEST_F(BlenderScenes, PortalsDoNotShine) {
  const Scene scene = load("portal");
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_EQ(scene.instances.size(), 1u);
}

TEST_F(BlenderScenes, WorldsThatTheCameraSeesOtherwise) {
  EXPECT_EQ(said("hidden_world").value("environment", ""), "1,0.5,0.25");
  EXPECT_EQ(said("hidden_world").value("background", ""), "0,0,0");
  EXPECT_EQ(said("two_worlds").value("environment", ""), "2,1,0.25");
  EXPECT_EQ(said("two_worlds").value("background", ""), "0,0,0.5");
  EXPECT_FALSE(said("portal").contains("background"));
}

// Metres, whatever the file's unit: a lens of 50 mm at f/0.5 is Blender's, 0.05 of its units wide.
TEST_F(BlenderScenes, LengthsOfTheCameraAreMetres) {
  const nlohmann::json file = said("focus"), camera = file["camera"];
  EXPECT_NEAR(file["unit"].get<double>(), 0.01, 1e-6);
  EXPECT_NEAR(camera["lens"]["focus_distance"].get<double>(), 2.0, 1e-6);
  EXPECT_NEAR(camera["lens"]["radius"].get<double>(), 0.05 * 0.01, 1e-9);
  EXPECT_NEAR(camera["ipd"].get<double>(), 0.064, 1e-6);
  EXPECT_NEAR(camera["position"][1].get<double>(), 0.016, 1e-6);
}

TEST_F(BlenderScenes, Lenses) {
  EXPECT_EQ(said("equisolid")["camera"]["projection"]["name"], "fisheye-equisolid");
  EXPECT_NEAR(said("equisolid")["camera"]["projection"]["fov"].get<double>(), 180.0, 1e-3);
  EXPECT_EQ(said("polynomial")["camera"]["projection"]["name"], "fisheye-polynomial");
  EXPECT_EQ(said("polynomial")["camera"]["projection"]["polynomial"].size(), 5u);
  EXPECT_TRUE(said("mirror_ball")["camera"].contains("projection"));
  for (const char* scene : {"equisolid", "polynomial", "mirror_ball"}) EXPECT_EQ(warnings(scene), "");
}

TEST_F(BlenderScenes, WhatChangesFromFrameToFrame) {
  EXPECT_EQ(said("moving")["frames"], (nlohmann::json{{"first", 11}, {"count", 10}, {"saved", 16}}));
  Scene scene = load("moving");
  EXPECT_NEAR(place_of(instance_of(scene, "walker")).x, 5.0f, 1e-4f) << "at rest: as it was saved";
  EXPECT_NEAR(material_of(scene, "sign").emission.x, 5.0f, 1e-4f);
  ASSERT_TRUE(play(scene.animation, ""));
  for (int frame = 11; frame <= 20; frame++) {
    const auto since = static_cast<float>(frame - 11);
    set_time(scene, static_cast<double>(since) / 24.0);
    EXPECT_NEAR(place_of(instance_of(scene, "walker")).x, since, 1e-4f) << frame;
    EXPECT_LT(length(material_of(scene, "sign").emission - vec3(1.0f, 0.5f, 0.25f) * since), 1e-3f) << frame;
    EXPECT_NEAR(material_of(scene, "sign").roughness, 0.1f + 0.1f * since, 1e-4f) << frame;
    const float share = since / 9.0f, watt = 10.0f / (4 * std::numbers::pi_v<float>);
    EXPECT_LT(length(scene.lights[0].intensity - vec3(1.0f - share, 0.0f, share) * watt), 1e-3f) << frame;
    EXPECT_EQ(is_hidden(scene, index_of(scene, "guest")), frame < 15) << frame;
    EXPECT_NEAR(scene.view_points[0].position.x, frame < 18 ? 0.0f : 5.0f, 1e-4f) << frame;
  }
}

TEST_F(BlenderScenes, PointsThatModifiersMove) {
  Scene scene = load("waves");
  ASSERT_TRUE(play(scene.animation, ""));
  for (int frame = 1; frame <= 5; frame++) {
    set_time(scene, (frame - 1) / 24.0);
    float highest = -1e9f;
    const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[0].mesh)];
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
      const vec4 p(scene.vertices[mesh.first_vertex + i].position, 1.0f);
      highest = std::max(highest, dot(scene.instances[0].row1, p));
    }
    EXPECT_NEAR(highest, std::max(2.0f, static_cast<float>(frame - 1)), 1e-3f) << frame;
  }
}

TEST_F(BlenderScenes, ParticlesFly) {
  Scene scene = load("sparks");
  ASSERT_TRUE(play(scene.animation, ""));
  const auto flying = [&](int frame) {
    set_time(scene, (frame - 1) / 24.0);
    int count = 0;
    for (const NamedObject& each : scene.objects) {
      const Instance& instance = scene.instances[each.first_instance];
      count += each.name.starts_with("spark.") && !is_hidden(scene, each.first_instance) && place_of(instance).y > 1.0f
                   ? 1
                   : 0;
    }
    return count;
  };
  EXPECT_LT(flying(1), 3);
  EXPECT_EQ(flying(6), 3);
}

// Frames of the beginning, and those by which the exposure is chosen, if no simulation is in them.
TEST_F(BlenderScenes, TheBeginningOfAFilmIsTheSame) {
  Scene whole = load("film"), begun = load("film begun");
  EXPECT_EQ(said("film begun")["frames"], said("film")["frames"]);
  EXPECT_EQ(warnings("film begun"), warnings("film"));
  EXPECT_LT(fs::file_size(path("film begun", "scene.glb")), fs::file_size(path("film", "scene.glb")) / 2);
  ASSERT_TRUE(play(whole.animation, "") && play(begun.animation, ""));
  EXPECT_EQ(length_of(whole.animation), length_of(begun.animation));
  const auto points = [](const Scene& scene, const char* name) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance_of(scene, name).mesh)];
    std::vector<float> all;
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
      const Vertex& vertex = scene.vertices[mesh.first_vertex + i];
      for (int c = 0; c < 3; c++) all.push_back(vertex.position[c]), all.push_back(vertex.normal[c]);
    }
    return all;
  };
  std::vector<float> still;
  for (const int frame : {1, 2, 3, 4, 5, 7, 19, 31, 43, 55, 60}) {
    set_time(whole, (frame - 1) / 24.0), set_time(begun, (frame - 1) / 24.0);
    if (frame == 1) still = points(whole, "cloth");
    EXPECT_EQ(points(whole, "sheet"), points(begun, "sheet")) << frame;
    EXPECT_EQ(instance_of(whole, "box").row0, instance_of(begun, "box").row0) << frame;
    EXPECT_EQ(whole.lights[0].intensity, begun.lights[0].intensity) << frame;
    EXPECT_EQ(whole.view_points[0].position, begun.view_points[0].position) << frame;
    if (frame > 5) continue;
    EXPECT_EQ(points(whole, "cloth"), points(begun, "cloth")) << frame;
    EXPECT_EQ(points(whole, "cloth") == still, frame == 1) << frame;
  }
}

}  // namespace ods::blender_scenes_test
