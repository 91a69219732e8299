// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods comfort as users run it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ods/image/image_file.h"
#include "tests/support/cli_runner.h"

namespace {

using Json = nlohmann::json;

class ComfortCommand : public Cli {
 protected:
  Json judged(const std::string& words) {
    code = run("comfort " + words + " --json");
    return Json::parse(out);
  }
  int code = 0;
};

// In the scene, and in the picture of it that is rendered afterwards.
TEST_F(ComfortCommand, ASceneAndItsPictureAreJudgedAlike) {
  const std::string camera = " --position 0,1,0.2 --merge none";
  const Json scene = judged("spheres --width 256" + camera);
  const std::string picture = folder.path("picture.exr");
  ASSERT_EQ(run("render spheres --width 256 --samples 1 -q -o " + picture + camera), 0) << err;
  const Json same = judged(picture);
  for (const auto& [level, share] : scene["share"].items()) EXPECT_NEAR(share, same["share"][level], 2e-3) << level;
  for (const auto& [strain, most] : scene["most"].items()) {
    EXPECT_NEAR(most, same["most"][strain], 0.03 * most.get<double>()) << strain;
  }
  EXPECT_EQ(scene["level"], same["level"]);
  EXPECT_NEAR(scene["nearest"], same["nearest"], 1e-3);
}

// What the report says would do, does.
TEST_F(ComfortCommand, ItsCuresCure) {
  const std::string words = "room --width 256 --position 1.9,0.5,0.4 --merge none";
  const Json before = judged(words);
  ASSERT_EQ(before["level"], "error") << out;
  EXPECT_EQ(code, 1);
  ASSERT_FALSE(before["places"].empty());
  EXPECT_GT(before["places"][0]["enough"], before["places"][0]["distance"]);
  const double ipd = 0.99 * before["largest_ipd"].get<double>();
  const Json after = judged(words + " --ipd " + std::to_string(ipd));
  EXPECT_TRUE(after["level"] == "caution" || after["level"] == "ok") << after["level"];
  EXPECT_EQ(code, 0);
}

// As much stereo as the limit allows, in the verdict before and after rendering.
TEST_F(ComfortCommand, AMergeByDepthCuresWhatIsAboveAndBelow) {
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

TEST_F(ComfortCommand, TextNamesThingsAndWhatWouldDo) {
  EXPECT_EQ(run("comfort room --width 256 --position 1.9,0.5,0.4 --merge none"), 1);
  EXPECT_NE(out.find("m would do"), std::string::npos) << out;
  EXPECT_NE(out.find("cure: move these things"), std::string::npos) << out;
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

TEST_F(ComfortCommand, BadInputIsOneLine) {
  ASSERT_EQ(run("render lamp --width 64 --samples 1 -q -o " + folder.path("flat.png")), 0) << err;
  EXPECT_EQ(run("comfort " + folder.path("flat.png")), 3);
  EXPECT_NE(err.find("has no depth"), std::string::npos) << err;
  EXPECT_EQ(run("comfort " + folder.path("absent.exr")), 3);
  EXPECT_EQ(run("comfort lamp --focus near"), 2);
  EXPECT_EQ(run("comfort lamp --rules none"), 2);
  EXPECT_EQ(run("comfort lamp --rules safe-sphere:-1"), 2);
  ASSERT_EQ(run("render lamp --width 64 --samples 1 -q -o " + folder.path("deep.exr")), 0) << err;
  EXPECT_EQ(run("comfort " + folder.path("deep.exr") + " --ipd 0.03"), 2);
  EXPECT_NE(err.find("--ipd is for scenes"), std::string::npos) << err;
}

}  // namespace
