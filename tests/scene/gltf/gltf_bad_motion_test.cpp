// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Animations, skins and morph targets that are damaged: an Error, or a Scene that keeps its promises at every time.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "ods/base/error.h"
#include "ods/scene/motion.h"
#include "tests/support/moving_files.h"
#include "tests/support/scene_check.h"

namespace ods::gltf_bad_motion_test {

// The reader's error; a file that it accepts is played.
std::string answer(const Binary& bytes) {
  try {
    Scene scene = load_gltf_bytes(bytes, "test.glb");
    EXPECT_EQ(broken_promise(scene), "") << "at rest";
    play(scene.animation, "");
    for (const double time : {-1.0, 0.0, 0.3, 1.0, 1e9}) {
      set_time(scene, time);
      EXPECT_EQ(broken_promise(scene), "") << time;
    }
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
}

// Everything that can move, in one file: accessors 0.. as make_skinned() has them, then what is added here.
GltfBuilder make_moving() {
  GltfBuilder file = make_skinned(false);
  const int delta = file.add<float>({0, 1, 0, 0, 1, 0, 0, 1, 0}, kFloat, "VEC3");
  file.primitive()["targets"] = {{{"POSITION", delta}, {"NORMAL", delta}}};
  file.primitive()["material"] = 0;
  file.json["materials"] = GltfJson::parse(R"([{"emissiveFactor": [1, 1, 1]}])");
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = GltfJson::parse(R"([{"type": "point"}])");
  file.node(1)["extensions"]["KHR_lights_punctual"]["light"] = 0;
  file.json["cameras"] = GltfJson::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
  file.node(2)["camera"] = 0;
  animate(file, node_target(0, "weights"), {0, 1}, {0, 1}, "SCALAR");
  animate(file, node_target(1, "translation"), {0, 1}, {0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0}, "VEC3",
          "CUBICSPLINE");
  animate(file, pointer("/extensions/KHR_lights_punctual/lights/0/intensity"), {0, 1}, {1, 2}, "SCALAR");
  animate(file, pointer("/materials/0/emissiveFactor"), {0, 1}, {1, 1, 1, 0, 0, 0}, "VEC3");
  return file;
}

TEST(GltfBadMotion, TheWholeFileIsSound) {
  EXPECT_EQ(answer(make_moving().glb()), "");
}

TEST(GltfBadMotion, FlippedBits) {
  std::mt19937 random(2);
  const Binary whole = make_moving().glb();
  for (int round = 0; round < 3000; round++) {
    answer(flip_bits(whole, 1 + round % 4, random));
  }
}

struct Breakage {
  const char* path;  // JSON pointer
  const char* value;
  const char* words;  // of the error; empty: the file is read without the broken part
};

class GltfMotionBreakage : public testing::TestWithParam<Breakage> {};

TEST_P(GltfMotionBreakage, IsAnErrorOrLeftOut) {
  GltfBuilder file = make_moving();
  file.json[GltfJson::json_pointer(GetParam().path)] = GltfJson::parse(GetParam().value);
  const std::string error = answer(file.glb());
  if (*GetParam().words == '\0') {
    EXPECT_EQ(error, "") << GetParam().path;
  } else {
    EXPECT_NE(error.find(GetParam().words), std::string::npos) << GetParam().path << ": '" << error << "'";
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, GltfMotionBreakage,
    testing::Values(
        Breakage{"/skins/0/joints", "[]", "no joints"}, Breakage{"/skins/0/joints", "[1]", "refers to joint 1"},
        Breakage{"/skins/0/joints", "[1, 77]", "node 77 does not exist"},
        Breakage{"/skins/0/joints", "[1, 2, 2]", "another number of matrices"},
        Breakage{"/skins/0/inverseBindMatrices", "99", "accessor 99 does not exist"},
        Breakage{"/skins/0/inverseBindMatrices", "1", "another number of matrices"},
        Breakage{"/nodes/0/skin", "5", "skin 5 does not exist"}, Breakage{"/nodes/2/children", "[1]", "own ancestors"},
        Breakage{"/nodes/0/weights", "[1e39, 3, 4, 5]", ""}, Breakage{"/nodes/0/weights", "[]", ""},
        Breakage{"/meshes/0/primitives/0/targets/0/POSITION", "99", "accessor 99 does not exist"},
        Breakage{"/meshes/0/primitives/0/targets/0/POSITION", "5", "components"},
        Breakage{"/meshes/0/primitives/0/attributes/WEIGHTS_0", "99", "accessor 99 does not exist"},
        Breakage{"/meshes/0/primitives/0/attributes/JOINTS_0", "0", "JOINTS_0 needs 4"},
        Breakage{"/animations/0/channels/0/sampler", "99", "animation sampler 99 does not exist"},
        Breakage{"/animations/0/channels/0/sampler", "\"x\"", "sampler that is not a whole number"},
        Breakage{"/animations/0/channels/0/target/node", "99", "node 99 does not exist"},
        Breakage{"/animations/0/channels/0/target/node", "-7", ""},
        Breakage{"/animations/0/channels/0/target/path", "\"colour\"", ""},
        Breakage{"/animations/0/channels/0/target", "3", ""},
        Breakage{"/animations/0/channels", "{\"a\": 1}", "channels is not a list"},
        Breakage{"/animations/0/channels", "17", "channels is not a list"},
        Breakage{"/animations/0/samplers", "{}", "not a list"},
        Breakage{"/animations/0/samplers/0/input", "99", "accessor 99 does not exist"},
        Breakage{"/animations/0/samplers/0/input", "-1", ""}, Breakage{"/animations/0/samplers/0/output", "0", ""},
        Breakage{"/animations/0/samplers/0/interpolation", "\"SMOOTH\"", ""},
        Breakage{"/animations/0/samplers/0/interpolation", "\"CUBICSPLINE\"", ""},
        Breakage{"/animations", "{}", "not a list"}, Breakage{"/animations", "[1, null, \"x\"]", ""}));

TEST(GltfBadMotion, PointersThatPointNowhere) {
  for (const std::string path : {"", "/", "/nodes", "/nodes/", "/nodes/0", "/nodes/0/", "/nodes/-1/scale",
                                 "/nodes/0x/scale", "/nodes/99999999999999/scale", "/materials/0/pbrMetallicRoughness",
                                 "/materials/0/alphaCutoff", "/cameras/0/perspective/yfov", "nodes/0/scale"}) {
    GltfBuilder file = make_moving();
    animate(file, pointer(path), {0, 1}, {1, 2}, "SCALAR");
    EXPECT_EQ(answer(file.glb()), "") << path;
  }
  for (const std::string path :
       {"/nodes/99/scale", "/materials/99/emissiveFactor", "/extensions/KHR_lights_punctual/lights/99/range"}) {
    GltfBuilder file = make_moving();
    animate(file, pointer(path), {0, 1}, {1, 2}, "SCALAR");
    EXPECT_NE(answer(file.glb()).find("99 does not exist"), std::string::npos) << path;
  }
}

TEST(GltfBadMotion, KeysThatAreNoNumbers) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const std::pair<std::vector<float>, std::vector<float>> keys[] = {
      {{0, nan}, {0, 1}}, {{0, inf}, {0, 1}}, {{1, 0}, {0, 1}}, {{0, 1}, {0, nan}}, {{0, 1}, {inf, 1}}, {{0}, {0, 1}}};
  for (const auto& [times, values] : keys) {
    GltfBuilder file = make_morphed();
    file.json.erase("animations");
    file.primitive()["targets"].erase(1);
    file.json["meshes"][0].erase("weights");
    animate(file, node_target(0, "weights"), times, values, "SCALAR");
    const Scene scene = file.load();
    EXPECT_TRUE(scene.animation.clips.empty());
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("invalid keys"), std::string::npos);
    EXPECT_EQ(answer(file.glb()), "");
  }
}

TEST(GltfBadMotion, WeightsAndMatricesThatAreNoNumbers) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  GltfBuilder file = make_skinned(false);
  file.primitive()["attributes"]["WEIGHTS_0"] =
      file.add<float>({nan, 0, 0, 0, -1, 3e38f, 3e38f, 0, 0, 0, 0, 0}, kFloat, "VEC4");
  EXPECT_EQ(answer(file.glb()), "");
  std::vector<float> matrices(32, 0.0f);
  matrices[7] = nan;
  file.json["skins"][0]["inverseBindMatrices"] = file.add<float>(matrices, kFloat, "MAT4");
  EXPECT_NE(answer(file.glb()).find("not finite"), std::string::npos);
  file.json["skins"][0]["inverseBindMatrices"] = file.add<float>(std::vector<float>(32, 0.0f), kFloat, "MAT4");
  EXPECT_EQ(answer(file.glb()), "") << "a figure that collapses into a point has no area, but harms nobody";
  GltfBuilder morphed = make_morphed();
  morphed.primitive()["targets"][0]["POSITION"] = morphed.add<float>({0, nan, 0, 0, 1, 0, 0, 1, 0}, kFloat, "VEC3");
  EXPECT_NE(answer(morphed.glb()).find("not finite"), std::string::npos);
}

// A small file must not ask for gigabytes by naming one accessor a million times.
TEST(GltfBadMotion, ManyNamesForTheSameNumbers) {
  GltfBuilder file = make_triangle();
  const std::vector<float> zeros(30000, 0.0f);
  std::vector<float> rising;
  for (int i = 0; i < 10000; i++) rising.push_back(static_cast<float>(i));
  animate(file, node_target(0, "translation"), rising, zeros, "VEC3");
  GltfJson& channels = file.json["animations"][0]["channels"];
  for (int i = 0; i < 500; i++) channels.push_back(channels[0]);
  EXPECT_NE(answer(file.glb()).find("far more"), std::string::npos);
  GltfBuilder morphed = make_triangle();
  std::vector<float> corners;
  for (int i = 0; i < 1000; i++) corners.insert(corners.end(), {0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int positions = morphed.add<float>(corners, kFloat, "VEC3");
  morphed.primitive()["attributes"]["POSITION"] = positions;
  for (int i = 0; i < 10000; i++) morphed.primitive()["targets"].push_back({{"POSITION", positions}});
  EXPECT_NE(answer(morphed.glb()).find("far more"), std::string::npos);
}

}  // namespace ods::gltf_bad_motion_test
