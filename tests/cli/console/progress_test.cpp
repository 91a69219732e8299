// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/progress.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace ods::progress_test {

// The output of a job of 100 seconds that reports twice a second.
std::string shown(ProgressMode mode, double until = 1.0) {
  std::ostringstream out;
  ProgressLines lines(mode, out);
  for (int i = 0; i <= static_cast<int>(until * 200.0); ++i) lines.report(i / 200.0, i / 2.0);
  return out.str();
}

size_t count(const std::string& text, const std::string& part) {
  size_t found = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Progress, EveryModeHasItsOwnName) {
  std::set<std::string_view> names;
  for (ProgressMode mode : kProgressModes) names.insert(progress_mode_name(mode));
  EXPECT_EQ(names.size(), std::size(kProgressModes));
  EXPECT_FALSE(names.contains(""));
}

TEST(Progress, OnlyTheBarMovesTheCursor) {
  for (ProgressMode mode : kProgressModes) {
    const bool moves = shown(mode).find_first_of("\r\x1b") != std::string::npos;
    EXPECT_EQ(moves, mode == ProgressMode::kBar) << progress_mode_name(mode);
  }
}

TEST(Progress, PlainIsALineForEveryTenthAndEveryHalfMinute) {
  const std::string text = shown(ProgressMode::kPlain);
  EXPECT_EQ(count(text, "\n"), 11u) << text;
  EXPECT_TRUE(text.starts_with("ods: 1.0 %, 1:39 min left\nods: 10 %, ")) << text;
  EXPECT_NE(text.find("ods: 40 %, 1:00 min left\n"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("ods: 100 %\n")) << text;
}

TEST(Progress, PlainSaysNothingOfAShortJob) {
  std::ostringstream out;
  ProgressLines lines(ProgressMode::kPlain, out);
  for (int i = 0; i <= 10; ++i) lines.report(i / 10.0, i / 50.0);
  EXPECT_EQ(out.str(), "");
}

TEST(Progress, JsonIsALineForEveryHundredth) {
  const std::string text = shown(ProgressMode::kJson);
  EXPECT_EQ(count(text, "\n"), 101u);
  EXPECT_NE(text.find("{\"progress\":0.2500,\"seconds\":25.0,\"seconds_left\":75.0}\n"), std::string::npos) << text;
}

// A video of 300 frames that takes ten hours, of which five minutes are over.
std::string video_shown(ProgressMode mode) {
  std::ostringstream out;
  ProgressLines lines(mode, out);
  for (int i = 0; i <= 600; ++i) {
    const double done = i / 72000.0;
    lines.report(done, i / 2.0, {"render", 1 + i / 240, 300, "a.\"\xff.exr"});
  }
  lines.clear();
  return out.str();
}

TEST(Progress, ALongVideoIsReportedByTime) {
  const std::string text = video_shown(ProgressMode::kPlain);
  EXPECT_TRUE(text.starts_with(
      "ods: 0 %, frame 1 of 300\nods: 0 %, frame 1 of 300\nods: 0 %, frame 1 of 300, 9:59:30 h left\n"))
      << text;
  EXPECT_NE(text.find("\nods: 0.1 %, frame 1 of 300, "), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("\nods: 0.8 %, frame 3 of 300, 9:55:00 h left\n")) << text;
  EXPECT_EQ(count(text, "\n"), 12u) << text;  // 1, 10, 30, 60, 90 ... 300 seconds
  EXPECT_EQ(count(video_shown(ProgressMode::kJson), "\n"), 13u);
  EXPECT_NE(video_shown(ProgressMode::kBar).find("] 0.8 %, frame 3 of 300, 9:55:00 h left"), std::string::npos);
  for (ProgressMode mode : {ProgressMode::kDeadline, ProgressMode::kTractor, ProgressMode::kOpenJd}) {
    EXPECT_EQ(count(video_shown(mode), "\n"), 1u) << "farms expect whole percents";
  }
}

// Half a minute of loading and the first tile of the first of many frames do not measure the rest.
TEST(Progress, NothingIsToldOfTheTimeFromNothing) {
  std::ostringstream out, json;
  ProgressLines lines(ProgressMode::kPlain, out), objects(ProgressMode::kJson, json);
  const double tile = 1e-9;
  for (ProgressLines* each : {&lines, &objects}) {
    each->report(tile, 30.0, {"render", 1, 100000, "a.exr"});
    each->report(2.0 * tile, 30.1, {"render", 1, 100000, "a.exr"});
    each->report(1e-5, 60.0, {"render", 1, 100000, "a.exr"});  // a frame in 29.9 seconds
  }
  EXPECT_EQ(out.str(), "ods: 0 %, frame 1 of 100000\nods: 0 %, frame 1 of 100000, 833:24:30 h left\n");
  EXPECT_EQ(json.str().find("seconds_left"), json.str().rfind("seconds_left")) << json.str();
  EXPECT_NE(json.str().find("\"seconds\":60.0,\"seconds_left\":3000"), std::string::npos) << json.str();
}

TEST(Progress, JsonNamesTheFrameAndTheFile) {
  const std::string text = video_shown(ProgressMode::kJson);
  const std::string last = text.substr(text.rfind('\n', text.size() - 2) + 1);
  const nlohmann::json object = nlohmann::json::parse(last, nullptr, false);
  ASSERT_TRUE(object.is_object()) << last;
  EXPECT_EQ(object["kind"], "render");
  EXPECT_EQ(object["frame"], 3);
  EXPECT_EQ(object["frames"], 300);
  EXPECT_EQ(object["file"], "a.\"\xef\xbf\xbd.exr");  // bytes that are not UTF-8 are replaced
  EXPECT_NEAR(object["progress"].get<double>(), 300.0 / 36000.0, 1e-4);
}

TEST(Progress, AShareOfAVideoIsAFrame) {
  EXPECT_EQ(video_step("encode", 0.0, 10, "a.mp4").frame, 1);
  EXPECT_EQ(video_step("encode", 0.55, 10, "a.mp4").frame, 6);
  EXPECT_EQ(video_step("encode", 1.0, 10, "a.mp4").frame, 10);
}

TEST(Progress, FarmsGetTheirOwnLines) {
  EXPECT_NE(shown(ProgressMode::kDeadline).find("Progress: 37%\n"), std::string::npos);
  EXPECT_NE(shown(ProgressMode::kTractor).find("ALF_PROGRESS 37%\n"), std::string::npos);
  EXPECT_NE(shown(ProgressMode::kOpenJd).find("openjd_progress: 37\n"), std::string::npos);
  for (ProgressMode mode : {ProgressMode::kDeadline, ProgressMode::kTractor, ProgressMode::kOpenJd}) {
    EXPECT_TRUE(progress_is_for_farm(mode));
    EXPECT_EQ(count(shown(mode), "\n"), 101u) << progress_mode_name(mode);
  }
  EXPECT_FALSE(progress_is_for_farm(ProgressMode::kJson));
}

TEST(Progress, OpenJobDescriptionHearsOfFailure) {
  std::ostringstream out;
  ProgressLines(ProgressMode::kOpenJd, out).fail("the disk\nis full");
  EXPECT_EQ(out.str(), "openjd_fail: the disk is full\n");
}

TEST(Progress, TheBarIsTakenOffTheScreen) {
  std::ostringstream out;
  {
    ProgressLines lines(ProgressMode::kBar, out);
    lines.report(0.5, 50.0);
    EXPECT_EQ(out.str(), "\r[################................]  50 %, 50 s left\x1b[K");
  }
  EXPECT_TRUE(out.str().ends_with("\r\x1b[K"));
}

TEST(Progress, NoneIsSilent) {
  EXPECT_EQ(shown(ProgressMode::kNone), "");
}

TEST(Progress, Durations) {
  EXPECT_EQ(duration_text(0.04), "0.0 s");
  EXPECT_EQ(duration_text(9.9), "9.9 s");
  EXPECT_EQ(duration_text(59.6), "1:00 min");
  EXPECT_EQ(duration_text(3723.0), "1:02:03 h");
}

}  // namespace ods::progress_test
