// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

namespace {

// What a job of 100 seconds writes when it reports twice a second.
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

TEST(Progress, PlainIsALineForEveryTenth) {
  const std::string text = shown(ProgressMode::kPlain);
  EXPECT_EQ(count(text, "\n"), 10u) << text;
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
  EXPECT_NE(text.find("{\"progress\":0.25,\"seconds\":25.0,\"seconds_left\":75.0}\n"), std::string::npos) << text;
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
  ProgressLines(ProgressMode::kOpenJd, out).fail("the disk is full");
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

}  // namespace
