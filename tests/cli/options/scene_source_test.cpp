// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options that choose the shown parts of a file, and the messages about its extensions.
#include <fstream>

#include "ods/image/image_file.h"
#include "ods/scene/builtin/shapes.h"
#include "tests/support/cli_runner.h"
#include "tests/support/moving_files.h"

namespace ods::scene_options_test {

using ods::GltfBuilder, ods::GltfJson;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class SceneOptionsOf : public Cli {
 protected:
  std::string save(const GltfBuilder& file, const std::string& name = "scene.glb") {
    const ods::Binary bytes = file.glb();
    folder.write(name, std::string(bytes.begin(), bytes.end()));
    return folder.path(name);
  }

  int render_file(const std::string& path, const std::string& words = "") {
    return run("render " + path + " --width 16 --samples 1 -o " + folder.path("picture.png") + " " + words);
  }

  GltfJson info(const std::string& path, const std::string& words = "") {
    EXPECT_EQ(run("info " + path + " --json " + words), 0) << err;
    return GltfJson::parse(out);
  }
};

TEST_F(SceneOptionsOf, InfoNamesWhatEachExtensionBecame) {
  GltfBuilder file = ods::make_triangle();
  file.json["extensionsUsed"] = {"KHR_xmp_json_ld", "VENDOR_thing", "KHR_texture_transform"};
  file.json["extensionsRequired"] = {"KHR_texture_transform"};
  const std::string path = save(file);
  ASSERT_EQ(run("info " + path), 0) << err;
  EXPECT_TRUE(has(out, "KHR_texture_transform: rendered (")) << out;
  EXPECT_TRUE(has(out, "KHR_xmp_json_ld: no effect (metadata)")) << out;
  EXPECT_TRUE(has(out, "VENDOR_thing: not rendered (unknown to ods)")) << out;
  const GltfJson list = info(path)["extensions"];
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list[0]["name"], "KHR_texture_transform");
  EXPECT_EQ(list[0]["state"], "rendered");
  EXPECT_EQ(list[0]["required"], true);
  EXPECT_EQ(list[2]["required"], false);
}

// Extensions that do not change the picture are not mentioned; missing ones are.
TEST_F(SceneOptionsOf, RenderingNamesOnlyWhatIsMissing) {
  GltfBuilder file = ods::make_triangle();
  file.json["extensionsUsed"] = {"KHR_xmp_json_ld", "MSFT_lod", "KHR_materials_variants"};
  ASSERT_EQ(render_file(save(file)), 0) << err;
  EXPECT_FALSE(has(err, "warning")) << err;
  file.json["extensionsUsed"].push_back("VENDOR_thing");
  ASSERT_EQ(render_file(save(file)), 0) << err;
  EXPECT_TRUE(has(err, "extension VENDOR_thing is not rendered")) << err;
}

// The triangle is put in front of the viewer, and hides a part of the furnace.
TEST_F(SceneOptionsOf, ObjectsAreInThePicture) {
  GltfBuilder file = ods::make_triangle();
  file.json["extensionsUsed"] = {"KHR_materials_unlit"};
  file.json["materials"] = GltfJson::parse(
      R"([{"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]}, "extensions": {"KHR_materials_unlit": {}}}])");
  file.primitive()["material"] = 0;
  const std::string with = " --with " + save(file), image = folder.path("picture.png");
  const std::string words = "render furnace --width 64 --samples 1 --eyes mono -q -o " + image;
  const auto black = [&] {
    const ods::Image picture = ods::read_image(image);
    int count = 0;
    for (size_t i = 0; i < picture.pixels.size(); i += static_cast<size_t>(picture.channels)) {
      count += picture.pixels[i] == 0.0f;
    }
    return count;
  };
  ASSERT_EQ(run(words), 0) << err;
  EXPECT_EQ(black(), 0);
  ASSERT_EQ(run(words + with + " --at 0.3,0.2,-0.9"), 0) << err;
  const int one = black();
  EXPECT_GT(one, 10);
  ASSERT_EQ(run(words + with + " --at 0.3,0.2,-0.9" + with + " --at 0.3,0.2,0.1 --turn 0 --turn 180"), 0) << err;
  EXPECT_NEAR(black(), 2 * one, 4);
  file.json["nodes"][0]["scale"] = {0.2, 0.2, 0.2};  // it keeps its size, although it would be shown larger on its own
  ASSERT_EQ(run(words + " --with " + save(file) + " --at 0.3,0.2,-0.9"), 0) << err;
  EXPECT_LT(10 * black(), one);
}

TEST_F(SceneOptionsOf, Variants) {
  GltfBuilder file = ods::make_triangle();
  file.json["extensionsUsed"] = {"KHR_materials_variants"};
  file.json["extensions"]["KHR_materials_variants"]["variants"] =
      GltfJson::parse(R"([{"name": "red"}, {"name": "blue"}])");
  file.json["materials"] =
      GltfJson::parse(R"([{"emissiveFactor": [1, 0, 0]}, {"pbrMetallicRoughness": {"metallicFactor": 0}}])");
  file.primitive()["material"] = 0;
  file.primitive()["extensions"]["KHR_materials_variants"]["mappings"] =
      GltfJson::parse(R"([{"variants": [1], "material": 1}])");
  const std::string path = save(file);
  EXPECT_EQ(info(path)["variants"], GltfJson::parse(R"(["red", "blue"])"));
  EXPECT_EQ(info(path)["emissive_triangles"], 1);
  EXPECT_EQ(info(path, "--variant blue")["emissive_triangles"], 0);
  EXPECT_EQ(render_file(path, "--variant blue"), 0) << err;
  ASSERT_EQ(run("info " + path), 0);
  EXPECT_TRUE(has(out, "variant        'red'")) << out;
  EXPECT_EQ(render_file(path, "--variant bleu"), 2);
  EXPECT_TRUE(has(err, "has no variant 'bleu'; did you mean 'blue'?")) << err;
  EXPECT_EQ(run(render("--variant red")), 2);
  EXPECT_TRUE(has(err, "built-in scene")) << err;
}

// A box of glass without a volume, before a glowing triangle.
GltfBuilder make_glass_box() {
  GltfBuilder file = ods::make_triangle();
  const ods::Shape box = ods::make_box(ods::vec3(1.0f));
  std::vector<float> positions;
  std::vector<uint32_t> corners;
  for (const ods::Vertex& v : box.vertices)
    positions.insert(positions.end(), {v.position.x, v.position.y, v.position.z});
  for (const ods::uvec3& t : box.triangles) corners.insert(corners.end(), {t.x, t.y, t.z});
  file.primitive()["attributes"]["POSITION"] = file.add<float>(positions, ods::kFloat, "VEC3");
  file.primitive()["indices"] = file.add<uint32_t>(corners, ods::kUint, "SCALAR");
  file.primitive()["material"] = 0;
  const int behind = file.add<float>({-3, -3, -2, 1, -3, -2, -1, 3, -2}, ods::kFloat, "VEC3");
  file.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", behind}}}, {"material", 1}});
  file.json["materials"] = {{{"name", "Ice"},
                             {"pbrMetallicRoughness",
                              {{"roughnessFactor", 0}, {"metallicFactor", 0}, {"baseColorFactor", {0.5, 0.5, 0.5, 1}}}},
                             {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}}},
                            {{"emissiveFactor", {1, 1, 1}}}};
  return file;
}

TEST_F(SceneOptionsOf, SolidGlass) {
  const std::string path = save(make_glass_box());
  const GltfJson glass = info(path)["sheet_glass"];
  ASSERT_EQ(glass.size(), 1u);
  EXPECT_EQ(glass[0], GltfJson::parse(R"({"material": "Ice", "closed_meshes": 1, "open_meshes": 0})"));
  ASSERT_EQ(run("info " + path), 0);
  EXPECT_TRUE(has(out, "'Ice' has no volume and is rendered as thin sheets (closed meshes: 1, open: 0)")) << out;
  EXPECT_TRUE(info(path, "--solid-glass")["sheet_glass"].empty());
  const std::string view = " --width 48 --samples 4 --position 0.3,0.2,1";
  ASSERT_EQ(render_file(path, view), 0) << err;
  EXPECT_TRUE(has(err, "--solid-glass makes it refract")) << err;
  const std::string sheet = folder.read("picture.png");
  ASSERT_EQ(render_file(path, "--solid-glass" + view), 0) << err;
  EXPECT_FALSE(has(err, "--solid-glass")) << err;
  EXPECT_NE(folder.read("picture.png"), sheet);
  ASSERT_EQ(run(render("--solid-glass")), 0) << err;
  EXPECT_TRUE(has(err, "--solid-glass changes nothing")) << err;
}

// --- scenes with nothing to see

TEST_F(SceneOptionsOf, NothingToSeeIsAnError) {
  const GltfJson hidden = {{"KHR_node_visibility", {{"visible", false}}}};
  GltfBuilder invisible = ods::make_triangle();
  invisible.node(0)["extensions"] = hidden;
  GltfBuilder flat = ods::make_triangle();
  flat.node(0)["scale"] = {0, 0, 0};
  GltfBuilder points = ods::make_triangle();
  points.primitive()["mode"] = 0;
  GltfBuilder empty = ods::make_triangle();
  empty.json["scenes"] = GltfJson::parse(R"([{}])");
  GltfBuilder always = ods::make_triangle();  // moves, and is hidden all the time
  always.node(0)["scale"] = {0, 1, 1};
  ods::animate(always, ods::node_target(0, "scale"), {0, 1, 2}, {0, 1, 1, 0, 1, 1, 0, 1, 1}, "VEC3");
  for (const GltfBuilder* file : {&invisible, &flat, &points, &empty, &always}) {
    const std::string path = save(*file);
    EXPECT_EQ(render_file(path), 3) << err;
    EXPECT_TRUE(has(err, "has nothing to render")) << err;
    EXPECT_EQ(run("info " + path), 0) << err;
  }
}

TEST_F(SceneOptionsOf, WhatAppearsLaterIsRendered) {
  GltfBuilder file = ods::make_triangle();  // visible for a moment, between two keys of another object
  ods::animate(file, ods::node_target(0, "scale"), {0, 1, 2}, {0, 0, 0, 1, 1, 1, 0, 0, 0}, "VEC3");
  file.node(0)["scale"] = {0, 0, 0};
  const std::string path = save(file);
  EXPECT_EQ(render_file(path, "--time 1"), 0) << err;
  EXPECT_EQ(render_file(path), 0) << err;
  EXPECT_TRUE(has(err, "everything is hidden while the scene is at rest")) << err;
}

}  // namespace ods::scene_options_test
