// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The verdict on pictures of two eyes; comfort_test.cpp has those on one.
#include "ods/comfort/verdict.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ods {
namespace {

// A wall 20 m away all around, and a block ahead.
SeenDepth seen_by(int eye, float block, const std::string& name = "") {
  SeenDepth seen{StereoCamera{}, eye, Image(256, 128, 1), {}, {}};
  std::ranges::fill(seen.depth.pixels, 20.0f);
  if (!name.empty()) {
    seen.names = {name};
    seen.things.assign(seen.depth.pixels.size(), -1);
  }
  for (int y = 60; y < 68; y++) {
    for (int x = 120; x < 136; x++) {
      *seen.depth.at(x, y) = block;
      if (!name.empty()) seen.things[static_cast<size_t>(y * seen.depth.width + x)] = 0;
    }
  }
  return seen;
}

constexpr float kFarAway = 20.0f, kTooNear = 0.3f;

TEST(Verdict, TheWorseEyeDecides) {
  const ComfortVerdict alone = judge_comfort(seen_by(kRight, kTooNear));
  for (const size_t worse : {size_t{0}, size_t{1}}) {
    const std::vector<SeenDepth> eyes = {seen_by(kLeft, worse == 0 ? kTooNear : kFarAway),
                                         seen_by(kRight, worse == 1 ? kTooNear : kFarAway)};
    const ComfortVerdict verdict = judge_comfort(eyes);
    EXPECT_EQ(verdict.level, ComfortLevel::kError) << worse;
    ASSERT_EQ(verdict.per_eye.size(), 2u);
    EXPECT_EQ(verdict.per_eye[worse].level, ComfortLevel::kError) << worse;
    EXPECT_EQ(verdict.per_eye[1 - worse].level, ComfortLevel::kOk) << worse;
    EXPECT_EQ(std::ranges::max(verdict.per_eye[worse].levels.pixels), static_cast<float>(ComfortLevel::kError));
    EXPECT_EQ(std::ranges::max(verdict.per_eye[1 - worse].levels.pixels), 0.0f);
    ASSERT_NE(verdict.worst(), nullptr);
    EXPECT_EQ(verdict.worst()->eye, worse);
    EXPECT_NEAR(verdict.nearest, double{kTooNear}, 0.01);
    EXPECT_NEAR(verdict.share[ComfortLevel::kError], 0.5 * alone.share[ComfortLevel::kError], 1e-9);
    EXPECT_NEAR(verdict.largest_ipd, alone.largest_ipd, 1e-6);
    EXPECT_NEAR(verdict.head_roll, alone.head_roll, 1e-6);
    EXPECT_EQ(verdict.max[Strain::kNear], alone.max[Strain::kNear]);
  }
}

TEST(Verdict, AThingThatBothEyesSeeIsListedOnce) {
  for (const std::string name : {"Lamp", ""}) {
    const std::vector<SeenDepth> eyes = {seen_by(kLeft, 0.5f, name), seen_by(kRight, kTooNear, name)};
    const ComfortVerdict verdict = judge_comfort(eyes);
    ASSERT_EQ(verdict.places.size(), 1u) << name;
    EXPECT_EQ(verdict.places[0].name, name);
    EXPECT_EQ(verdict.places[0].eye, 1u);
    EXPECT_NEAR(verdict.places[0].distance, double{kTooNear}, 0.01);
    EXPECT_NEAR(verdict.places[0].share,
                verdict.share[ComfortLevel::kError] + verdict.share[ComfortLevel::kWarning] +
                    verdict.share[ComfortLevel::kCaution],
                1e-9);
  }
}

TEST(Verdict, ADifferenceInHeightCounts) {
  const std::vector<SeenDepth> eyes = {seen_by(kLeft, kFarAway), seen_by(kRight, kFarAway)};
  EXPECT_EQ(judge_comfort(eyes).level, ComfortLevel::kOk);
  for (const auto& [apart, level] : {std::pair{5.0, ComfortLevel::kOk},
                                     {20.0, ComfortLevel::kCaution},
                                     {30.0, ComfortLevel::kWarning},
                                     {70.0, ComfortLevel::kError}}) {
    const ComfortVerdict verdict = judge_comfort(eyes, {}, MatchQuality{0.9, 4.0, apart});
    EXPECT_EQ(verdict.level, level) << apart;
    EXPECT_EQ(verdict.apart, level) << apart;
    EXPECT_EQ(verdict.worst(), nullptr);
  }
}

TEST(Verdict, ItsLineNamesTheWorstPlace) {
  const std::vector<SeenDepth> eyes = {seen_by(kLeft, kFarAway, "Lamp"), seen_by(kRight, kTooNear, "Lamp")};
  const std::string line = strain_line(judge_comfort(eyes), ComfortLevel::kError);
  EXPECT_TRUE(line.starts_with("'Lamp', 0.3")) << line;
  EXPECT_NE(line.find("move it at least "), std::string::npos) << line;
  EXPECT_EQ(strain_line(judge_comfort(eyes[0]), ComfortLevel::kCaution), "");
}

}  // namespace
}  // namespace ods
