// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods comfort as users run it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "ods/files/atomic_file.h"
#include "ods/image/image_file.h"
#include "tests/support/cli_runner.h"
#include "tests/support/exr_files.h"
#include "tests/support/gltf_builder.h"

namespace ods::comfort_command_test {

using Json = nlohmann::json;

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

class ComfortCommand : public Cli {
 protected:
  Json judged(const std::string& words) {
    code = run("comfort " + words + " --json");
    return Json::parse(out);
  }
  // A mono lat-long whose depth follows the elevation, but for pillars ahead and behind.
  void write_depth(const std::string& name, const std::string& channel, const std::function<float(float)>& depth) {
    constexpr int kWidth = 256, kHeight = 128;
    ods::ExrForm form;
    form.width = kWidth, form.height = kHeight;
    form.channels = {"B", "G", "R", channel};
    form.types = {Imf::FLOAT, Imf::FLOAT, Imf::FLOAT, Imf::FLOAT};
    std::vector<float> values;
    for (int y = 0; y < kHeight; y++) {
      for (int x = 0; x < kWidth; x++) {
        const bool is_pillar = x % 32 < 8 && y > kHeight / 4 && y < kHeight * 5 / 8;
        const float elevation = 90.0f - 180.0f * (static_cast<float>(y) + 0.5f) / kHeight;
        values.insert(values.end(), {0.2f, 0.2f, 0.2f, depth(is_pillar ? -20.0f : elevation)});
      }
    }
    write_exr_of(folder.path(name), form, values);
  }

  int code = 0;
};

// Metres: a floor 1.6 m below, and the sky.
float street(float elevation) {
  return elevation < 0.0f ? 1.6f / std::sin(-elevation * 3.14159f / 180.0f) : 1e10f;
}

// Depth in 1 / metres, or as a share of the farthest, interpreted as metres.
float inverted_street(float elevation) {
  return 0.5f + 20.0f / std::min(street(elevation), 40.0f);
}

// In the scene, and in the picture of it that is rendered afterwards.
TEST_F(ComfortCommand, ASceneAndItsPictureAreJudgedAlike) {
  const std::string camera = " --position 0,1,0.2 --merge none";
  const Json scene = judged("spheres --width 256" + camera);
  const std::string picture = folder.path("picture.exr");
  ASSERT_EQ(run("render spheres --width 256 --samples 1 -q -o " + picture + camera), 0) << err;
  const Json same = judged(picture);
  for (const auto& [level, share] : scene["share"].items()) EXPECT_NEAR(share, same["share"][level], 2e-3) << level;
  for (const auto& [strain, maximum] : scene["most"].items()) {
    EXPECT_NEAR(maximum, same["most"][strain], 0.03 * maximum.get<double>()) << strain;
  }
  EXPECT_EQ(scene["level"], same["level"]);
  EXPECT_NEAR(scene["nearest"], same["nearest"], 1e-3);
}

// The distances in the report suffice.
TEST_F(ComfortCommand, ItsRemediesHelp) {
  const std::string words = "room --width 256 --position 1.9,0.5,0.4 --merge none";
  const Json before = judged(words);
  ASSERT_EQ(before["level"], "error") << out;
  EXPECT_EQ(code, 5);
  ASSERT_FALSE(before["places"].empty());
  EXPECT_GT(before["places"][0]["enough"], before["places"][0]["distance"]);
  const double ipd = 0.99 * before["largest_ipd"].get<double>();
  const Json after = judged(words + " --ipd " + std::to_string(ipd));
  EXPECT_TRUE(after["level"] == "caution" || after["level"] == "ok") << after["level"];
  EXPECT_EQ(code, 0);
}

// As much stereo as the limit allows, in the verdict before and after rendering.
TEST_F(ComfortCommand, AMergeByDepthHelpsAboveAndBelow) {
  const std::string words = "room --width 256 --merge auto,30";
  const Json scene = judged(words);
  EXPECT_LE(scene["most"]["vertical"], 30.5);
  EXPECT_GE(scene["most"]["vertical"], 20.0);
  const std::string picture = folder.path("picture.exr");
  ASSERT_EQ(run("render " + words + " --samples 1 --sidecar -o " + picture), 0) << err;
  EXPECT_NE(err.find("merge by depth: full stereo up to "), std::string::npos) << err;
  const Json rendered = judged(picture);
  EXPECT_NEAR(rendered["most"]["vertical"], scene["most"]["vertical"], 0.5);
  EXPECT_EQ(run("comfort room --merge auto,0"), 2);
  EXPECT_EQ(run("testcard -o " + folder.path("card.png") + " --merge auto"), 2);
}

// The picture itself keeps the merge; where one is missing that only a sidecar keeps, the eyes show it.
TEST_F(ComfortCommand, AMergeMapIsNotForgotten) {
  const std::string words = " --width 512 --samples 4 --bounces 1 -q ";
  const std::string merged = folder.path("merged.exr");
  ASSERT_EQ(run("render room --merge auto" + words + "-o " + merged), 0) << err;
  const Json alone = judged(merged);
  EXPECT_LE(alone["most"]["vertical"], 26.0);
  EXPECT_FALSE(alone.contains("matched"));

  // Eyes half as far apart, and in one column a little more, so that the map is not a curve.
  ods::ExrForm form;
  form.width = 8, form.height = 4, form.channels = {"B", "G", "R"};
  form.types = {Imf::FLOAT, Imf::FLOAT, Imf::FLOAT};
  std::vector<float> map(8 * 4 * 3, 0.5f);
  std::fill_n(map.begin(), 3, 0.52f);
  write_exr_of(folder.path("map.exr"), form, map);
  const std::string near = folder.path("near.exr");
  ASSERT_EQ(run("render room --position 1.9,0.5,0.4 --merge-map " + folder.path("map.exr") + words + "-o " + near), 0)
      << err;
  const Json found = judged(near);
  EXPECT_TRUE(found.contains("matched")) << out;
  EXPECT_LT(found["share"]["error"], 0.15) << out;  // by its depth, as if it had no merge: 0.25
  run("comfort " + near);
  EXPECT_NE(out.find("Its merge map is missing"), std::string::npos) << out;
}

// Another renderer's picture with depth and without camera metadata: the command measures the merge from its eyes.
TEST_F(ComfortCommand, AMergeThatNobodyWroteDownIsMeasured) {
  const std::string own = folder.path("own.exr"), foreign = folder.path("foreign_360_TB.exr");
  ods::ExrForm form;
  form.width = form.height = 1024;
  form.channels = {"B", "G", "R", "Z"};
  form.types = {Imf::HALF, Imf::HALF, Imf::HALF, Imf::FLOAT};
  ASSERT_EQ(run("render room --width 1024 --samples 2 --bounces 1 -q --merge cosine,45,75 -o " + own), 0) << err;
  ods::write_exr(foreign, form, ods::read_exr(own, form));
  const Json exact = judged(own), found = judged(foreign);
  EXPECT_FALSE(exact.contains("measured"));
  ASSERT_TRUE(found.contains("measured")) << out << err;
  EXPECT_EQ(found["measured"]["merged"], true);
  for (const auto& [level, share] : exact["share"].items()) EXPECT_NEAR(share, found["share"][level], 0.04) << level;
  run("comfort " + foreign);
  EXPECT_NE(out.find(", a pole merge with full stereo up to "), std::string::npos) << out;
}

TEST_F(ComfortCommand, TextNamesThingsAndWhatWouldDo) {
  EXPECT_EQ(run("comfort room --width 256 --position 1.9,0.5,0.4 --merge none"), 5);
  EXPECT_EQ(err.find("error:"), std::string::npos) << "a verdict is not a failure: " << err;
  EXPECT_NE(out.find("move it at least "), std::string::npos) << out;
  EXPECT_NE(out.find("remedy: move these things"), std::string::npos) << out;
  EXPECT_NE(out.find("by solid angle"), std::string::npos) << out;
  EXPECT_EQ(run("comfort furnace --width 64 --rules safe-sphere:0.1"), 0) << out << err;
}

TEST_F(ComfortCommand, TheHeatIsAPictureOfBothEyes) {
  const std::string heat = folder.path("heat_360_TB.png");
  run("comfort room --width 256 --position 1.9,0.5,0.4 --merge none --heat " + heat);
  const ods::FileInfo info = ods::read_info(heat);
  EXPECT_EQ(info.width, 256);
  EXPECT_EQ(info.height, 256);
}

// Every part of the report has the verdict of both eyes, whichever of them strains.
TEST_F(ComfortCommand, TheWorseEyeDecides) {
  const auto far = [](float) { return 20.0f; };
  const auto near = [](float elevation) { return elevation == -20.0f ? 0.3f : 20.0f; };  // pillars
  for (const std::string worse : {"left", "right"}) {
    const std::string better = worse == "left" ? "right" : "left";
    write_depth("pair_" + worse + ".exr", "Z", near);
    write_depth("pair_" + better + ".exr", "Z", far);
    const std::string pair = folder.path("pair_%V.exr"), page = folder.path("pair.html");
    EXPECT_EQ(run("comfort " + pair + " --html " + page), 5) << err;
    EXPECT_NE(out.find("pair_%V.exr: error;"), std::string::npos) << out;
    EXPECT_NE(out.find(worse + " eye: error"), std::string::npos) << out;
    EXPECT_NE(out.find("error: an area, 0.3"), std::string::npos) << out;
    EXPECT_EQ(err.find("error:"), std::string::npos) << err;
    EXPECT_NE(text_of(page).find("<b class=\"error\">error</b></h1>"), std::string::npos);
    EXPECT_NE(text_of(page).find("The " + worse + " eye:"), std::string::npos);
    const Json found = judged(pair);
    EXPECT_EQ(code, 5);
    EXPECT_EQ(found["level"], "error");
    EXPECT_EQ(found["eyes"][worse], "error");
    EXPECT_EQ(found["eyes"][better], "ok");
    EXPECT_EQ(found["places"][0]["eye"], worse);
    EXPECT_GT(found["share"]["error"], 0.0);
  }
}

// Without depth, by matching the eyes: the same verdict as with it, and how sure it is.
TEST_F(ComfortCommand, APictureWithoutDepthIsMatched) {
  const std::string words =
      "render room --width 512 --samples 4 --bounces 1 -q --position 1.9,0.5,0.4 --merge none -o ";
  ASSERT_EQ(run(words + folder.path("x.exr")), 0) << err;
  ASSERT_EQ(run("convert -q " + folder.path("x.exr") + " -o " + folder.path("x_360_TB.jpg")), 0) << err;
  const Json exact = judged(folder.path("x.exr"));
  const Json found = judged(folder.path("x_360_TB.jpg"));
  EXPECT_EQ(code, 5);
  EXPECT_EQ(found["level"], exact["level"]);
  EXPECT_NEAR(found["nearest"], exact["nearest"], 0.15 * exact["nearest"].get<double>());
  EXPECT_GT(found["matched"]["share"], 0.3);
  EXPECT_LT(found["matched"]["precision"], 20.0);
  const std::string page = folder.path("report.html");
  run("comfort " + folder.path("x_360_TB.jpg") + " --html " + page);
  EXPECT_NE(out.find("of the picture could be matched"), std::string::npos) << out;
  const std::string html = text_of(page);
  EXPECT_NE(html.find("data:image/jpeg;base64,"), std::string::npos);
  EXPECT_NE(html.find("The worst strains"), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos) << "it needs nothing from outside";
  run("lint " + folder.path("x_360_TB.jpg"));
  EXPECT_NE(out.find("nearest thing about 0.4"), std::string::npos) << out;
}

// A thing of a scene has its name in the picture, too, if that was asked for.
TEST_F(ComfortCommand, ThingsAreNamedInPictures) {
  ods::GltfBuilder builder = ods::make_triangle();
  builder.node(0)["name"] = "Sail <1>";
  builder.node(0)["translation"] = {0.0, 0.0, -0.5};
  const auto bytes = builder.glb();
  const std::string scene = folder.path("sail.glb"), picture = folder.path("sail.exr");
  ods::write_file(scene, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const std::string words = "render " + scene + " --unit m --width 256 --samples 1 --position 0.2,0.2,0 -q -o ";
  ASSERT_EQ(run(words + picture + " --object-layer"), 0) << err;
  const std::string turned = folder.path("turned.exr");  // a copy keeps the names
  ASSERT_EQ(run("convert " + picture + " --yaw 30 -q -o " + turned), 0) << err;
  for (const std::string& each : {picture, turned}) {
    const Json places = judged(each)["places"];
    EXPECT_TRUE(std::ranges::any_of(places, [](const Json& place) { return place["name"] == "Sail <1>"; })) << places;
  }
  EXPECT_EQ(run(words + folder.path("sail.png") + " --object-layer"), 2);
  EXPECT_NE(err.find("--object-layer"), std::string::npos) << err;
  run("comfort " + picture + " --html " + folder.path("sail.html"));
  EXPECT_NE(text_of(folder.path("sail.html")).find("Sail &lt;1&gt;"), std::string::npos);
  ASSERT_EQ(run("info " + scene + " --unit m --position 0.2,0.2,0"), 0) << err;
  EXPECT_NE(out.find("'Sail <1>', 0."), std::string::npos) << out;
}

// Moving the first thing of each report as it suggests leads to a clean report.
TEST_F(ComfortCommand, AReaderOfTheReportKnowsWhatToMove) {
  std::array<double, 3> place = {0.35, 0.1, -0.2};  // of the sail, from the camera
  const std::string scene = folder.path("sail.glb");
  const auto report = [&] {
    ods::GltfBuilder builder = ods::make_triangle();
    builder.node(0)["name"] = "Sail";
    builder.node(0)["scale"] = {0.2, 0.2, 0.2};
    builder.node(0)["translation"] = place;
    const auto bytes = builder.glb();
    ods::write_file(scene, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    code = run("comfort " + scene + " --unit m --width 512 --position 0,0,0");
    return out;
  };
  int moves = 0;
  for (std::string text = report(); code != 0 || text.find("warning: ") != std::string::npos; text = report()) {
    ASSERT_LT(moves++, 3) << text;
    std::smatch words;
    ASSERT_TRUE(std::regex_search(
        text, words,
        std::regex("(?:error|warning): 'Sail', ([0-9.]+) m away, (?:([0-9]+) degrees? "
                   "(left|right)|ahead)(?:, ([0-9]+)(?: degrees?)? (up|down))?.*; move it at least ([0-9.]+) m away")))
        << text;
    const auto number = [&](size_t i) { return words[i].matched ? std::stod(words[i]) : 0.0; };
    const double away = number(6) - number(1) + 0.02;
    const double around = number(2) * (words[3] == "left" ? -1 : 1) * 3.14159 / 180.0;
    const double above = number(4) * (words[5] == "down" ? -1 : 1) * 3.14159 / 180.0;
    place[0] += away * std::cos(above) * std::sin(around);
    place[1] += away * std::sin(above);
    place[2] -= away * std::cos(above) * std::cos(around);
  }
  EXPECT_GE(moves, 1) << "nothing was wrong";
}

// One line before a long rendering, none before a short one.
TEST_F(ComfortCommand, ALongRenderingIsWarnedOf) {
  const std::string words = "render room --bounces 0 --indirect path --position 1.9,0.5,0.4 --merge none -o ";
  ASSERT_EQ(run(words + folder.path("a.png") + " --width 256 --samples 400 --noise 1"), 0) << err;
  const size_t said = err.find("strains the viewer's eyes");
  ASSERT_NE(said, std::string::npos) << err;
  EXPECT_EQ(err.find("strains the viewer's eyes", said + 1), std::string::npos) << err;
  ASSERT_EQ(run(words + folder.path("b.png") + " --width 64 --samples 1"), 0) << err;
  EXPECT_EQ(err.find("strains"), std::string::npos) << err;
}

TEST_F(ComfortCommand, ViewersAndHeadsetsByName) {
  const Json usual = judged("room --width 128 --viewer-ipd 65mm"), child = judged("room --width 128 --viewer-ipd 50mm"),
             rift = judged("room --width 128 --focus rift");
  EXPECT_NEAR(usual["viewer_ipd"], 0.065, 1e-6);
  EXPECT_NEAR(child["viewer_ipd"], 0.05, 1e-6);
  EXPECT_NEAR(rift["focus"], 2.0, 1e-6);
  EXPECT_GT(child["most"]["near"], usual["most"]["near"]);
  EXPECT_EQ(run("comfort room --viewer-ipd 5mm"), 2);
  EXPECT_NEAR(usual["looked"]["ok"].get<double>() + usual["looked"]["caution"].get<double>() +
                  usual["looked"]["warning"].get<double>() + usual["looked"]["error"].get<double>(),
              1.0, 1e-6);
}

// Each fault of a layer of depth has its line and its exit code.
TEST_F(ComfortCommand, DepthWithoutSenseIsSaid) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  struct Row {
    const char* says;
    int code;
    std::function<float(float elevation)> depth;  // degrees
  };
  const Row rows[] = {{"0, negative or NaN everywhere", 3, [](float) { return 0.0f; }},
                      {"0, negative or NaN everywhere", 3, [](float) { return -2.0f; }},
                      {"0, negative or NaN everywhere", 3, [](float) { return std::nanf(""); }},
                      {"infinite everywhere", 0, [](float) { return kInfinity; }},
                      {"have no depth, and are not judged", 5, [](float e) { return e > 0.0f ? std::nanf("") : 3.0f; }},
                      {"looks inverted", 5, inverted_street}};
  for (const Row& row : rows) {
    write_depth("bad.exr", "Z", row.depth);
    EXPECT_EQ(run("comfort " + folder.path("bad.exr")), row.code) << row.says << "\n" << err;
    const size_t end = err.find(row.says);
    ASSERT_NE(end, std::string::npos) << row.says << "\n" << err;
    const std::string line = err.substr(err.rfind("ods: ", end), end);
    EXPECT_NE(line.find("bad.exr"), std::string::npos) << line;
    EXPECT_EQ(line.find("bad.exr"), line.rfind("bad.exr")) << line;
  }
  // Blender's name, and an upright street, which is not a mistake.
  write_depth("blender.exr", "ViewLayer.Depth.Z", street);
  const Json found = judged(folder.path("blender.exr"));
  EXPECT_EQ(err.find("inverted"), std::string::npos) << err;
  EXPECT_NEAR(found["nearest"], 1.6, 0.1);
}

TEST_F(ComfortCommand, BadInputIsOneLine) {
  ASSERT_EQ(run("render lamp --width 64 --samples 1 -q -o " + folder.path("flat.png")), 0) << err;
  EXPECT_EQ(run("comfort " + folder.path("flat.png") + " --layout top-bottom"), 3);
  EXPECT_NE(err.find("too few to be matched"), std::string::npos) << err;
  ASSERT_EQ(run("render lamp --width 64 --samples 1 -q --eyes left -o " + folder.path("one.png")), 0) << err;
  EXPECT_EQ(run("comfort " + folder.path("one.png")), 3);
  EXPECT_NE(err.find("has one eye and no depth"), std::string::npos) << err;
  EXPECT_EQ(run("comfort " + folder.path("absent.exr")), 3);
  EXPECT_EQ(run("comfort lamp --focus near"), 2);
  EXPECT_EQ(run("comfort lamp --rules none"), 2);
  EXPECT_EQ(run("comfort lamp --rules safe-sphere:-1"), 2);
  ASSERT_EQ(run("render lamp --width 64 --samples 1 -q -o " + folder.path("deep.exr")), 0) << err;
  EXPECT_EQ(run("comfort " + folder.path("deep.exr") + " --ipd 0.03"), 2);
  EXPECT_NE(err.find("--ipd is for scenes"), std::string::npos) << err;
  folder.write("empty.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": []}], "scene": 0})");
  for (const std::string& command : {std::string("comfort "), "rig -o " + folder.path("rig.json") + " --scene "}) {
    EXPECT_EQ(run(command + folder.path("empty.gltf")), 3);
    EXPECT_NE(err.find("has nothing to render"), std::string::npos) << err;
  }
}

// A picture is recognised by its first bytes, too.
TEST_F(ComfortCommand, TheNameOfAPictureDoesNotMatter) {
  ASSERT_EQ(run("render lamp --width 64 --samples 1 -q -o " + folder.path("deep.exr")), 0) << err;
  const int of_picture = run("comfort " + folder.path("deep.exr"));
  const std::string said = out.substr(out.find(": "));
  std::filesystem::rename(folder.path("deep.exr"), folder.path("deep.dat"));
  EXPECT_EQ(run("comfort " + folder.path("deep.dat")), of_picture) << err;
  EXPECT_EQ(out.substr(out.find(": ")), said);
}

}  // namespace ods::comfort_command_test
