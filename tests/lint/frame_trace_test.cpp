// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames in memory, as each eye sees them: a thing that jumps about, a camera that turns.
#include "ods/lint/frame_trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

namespace ods {
namespace {

constexpr Extent kFrame{128, 128};
constexpr double kRate = 25.0;

// The place of the thing at a time: it moves unevenly, and starts over.
int place(int time) {
  std::mt19937 engine(3);
  int at = 20;
  for (int i = 0; i < time; i++) at += 1 + static_cast<int>(engine() % 8);
  return at % 100;
}

// The time and the shot that each eye shows in a frame, and how far its camera is turned.
struct Moment {
  int time[2];
  int shot[2] = {0, 0};
  int turned[2] = {0, 0};
};

// The picture of an eye. The right eye sees the thing a little farther left.
void draw(std::vector<std::byte>& luma, const Moment& moment, int eye) {
  const int from = place(moment.time[eye]) - 2 * eye, top = 10 + from / 3, shot = moment.shot[eye];
  for (int y = 0; y < kFrame.height / 2; y++) {
    for (int x = 0; x < kFrame.width; x++) {
      const int column = (x + moment.turned[eye]) % kFrame.width, slope = std::min(column, kFrame.width - column);
      const int ground = 80 - y + 40 * ((column / 16 + y / 8 + shot) % 2) + (shot % 2 == 0 ? slope : 60 - slope);
      const bool is_thing = x >= from && x < from + 20 && y > top && y < top + 16;
      luma[static_cast<size_t>((y + eye * kFrame.height / 2) * kFrame.width + x)] =
          static_cast<std::byte>(is_thing ? ground + 40 : ground);
    }
  }
}

LintReport report_of(int frames, const std::function<void(int frame, std::vector<std::byte>& luma)>& paint) {
  FrameTrace trace(kFrame, Layout::kTopBottom);
  std::vector<std::byte> luma(static_cast<size_t>(kFrame.width * kFrame.height));
  for (int i = 0; i < frames; i++) {
    paint(i, luma);
    DecodedFrame frame;
    frame.planes.first[0] = luma.data();
    frame.planes.stride[0] = static_cast<size_t>(kFrame.width);
    trace.add(frame, i / kRate);
  }
  EXPECT_EQ(trace.frames(), frames);
  LintReport report;
  trace.report(report);
  return report;
}

LintReport report_of(const std::vector<Moment>& moments) {
  return report_of(static_cast<int>(moments.size()), [&](int i, std::vector<std::byte>& luma) {
    for (const int eye : {0, 1}) draw(luma, moments[static_cast<size_t>(i)], eye);
  });
}

std::vector<Moment> moments(int count, int right_late = 0) {
  std::vector<Moment> all;
  for (int i = 0; i < count; i++) all.push_back({{i + 20, i + 20 - right_late}});
  return all;
}

bool judged(const LintReport& report, Check check) {
  return std::count(report.judged.begin(), report.judged.end(), check) == 1;
}

TEST(FrameTrace, OfEyesThatAreTogetherHasNoFault) {
  const LintReport report = report_of(moments(60));
  EXPECT_TRUE(report.findings.empty()) << report.findings[0].evidence;
  EXPECT_TRUE(judged(report, Check::kEyeTime));
  EXPECT_TRUE(judged(report, Check::kDuplicates));
  EXPECT_FALSE(judged(report, Check::kCuts));  // there are none
}

TEST(FrameTrace, MeasuresHowLateAnEyeIs) {
  for (const int late : {1, 4, -3}) {
    const LintReport report = report_of(moments(60, late));
    ASSERT_EQ(report.findings.size(), 1u) << late;
    EXPECT_EQ(report.findings[0].fault, Fault::kEyeLate);
    EXPECT_GT(report.findings[0].certainty, 0.5);
    const std::string frames = std::to_string(std::abs(late)) + " frames";
    EXPECT_NE(report.findings[0].evidence.find(frames), std::string::npos) << report.findings[0].evidence;
    EXPECT_NE(report.findings[0].evidence.find(late > 0 ? "later" : "earlier"), std::string::npos);
    EXPECT_NE(report.findings[0].remedy.find(frames), std::string::npos) << report.findings[0].remedy;
  }
}

TEST(FrameTrace, MeasuresHowLateAnEyeIsByTheTurnsOfTheCamera) {
  for (const int late : {0, 1, -4}) {
    std::vector<Moment> all;
    const auto turned = [](int time) { return static_cast<int>(60.0 + 30.0 * std::sin(0.2 * time)); };
    for (int i = 0; i < 60; i++) all.push_back({{7, 7}, {0, 0}, {turned(i + 20), turned(i + 20 - late)}});
    LintReport report = report_of(all);
    EXPECT_TRUE(judged(report, Check::kEyeTime));
    // Turns of whole pixels stop where they change their way.
    std::erase_if(report.findings, [](const Finding& finding) { return finding.fault == Fault::kDuplicateFrames; });
    ASSERT_EQ(report.findings.size(), late == 0 ? 0u : 1u) << late;
    if (late == 0) continue;
    const std::string frames = std::to_string(std::abs(late)) + " frames";
    EXPECT_GT(report.findings[0].certainty, 0.5);
    EXPECT_NE(report.findings[0].evidence.find(frames), std::string::npos) << report.findings[0].evidence;
  }
}

// At each heading it is there later in the right eye.
TEST(FrameTrace, WhatPassesByIsNotLate) {
  const LintReport report = report_of(80, [](int i, std::vector<std::byte>& luma) {
    for (int y = 0; y < kFrame.height; y++) {
      const int eye = y / (kFrame.height / 2), row = y % (kFrame.height / 2);
      const int middle = i + 10 * (1 - eye), top = 20 + (i + i / 8) % 20;
      for (int x = 0; x < kFrame.width; x++) {
        const bool is_thing = std::abs(x - middle) < 10 && row > top && row < top + 14;
        luma[static_cast<size_t>(y * kFrame.width + x)] =
            static_cast<std::byte>(is_thing ? 200 : 80 + (x * 7 + row) % 9);
      }
    }
  });
  EXPECT_TRUE(judged(report, Check::kEyeTime));
  EXPECT_TRUE(report.findings.empty()) << report.findings[0].evidence;
}

TEST(FrameTrace, FindsFramesThatAreThereTwice) {
  std::vector<Moment> all = moments(60);
  all[20] = all[19];
  all[40] = all[39];
  const LintReport report = report_of(all);
  ASSERT_EQ(report.findings.size(), 1u);
  EXPECT_EQ(report.findings[0].fault, Fault::kDuplicateFrames);
  EXPECT_TRUE(report.findings[0].evidence.starts_with("2 of ")) << report.findings[0].evidence;
  EXPECT_NE(report.findings[0].evidence.find("at 0.80 s, 1.60 s"), std::string::npos) << report.findings[0].evidence;
}

TEST(FrameTrace, FindsEverySecondFrameTwice) {
  std::vector<Moment> all = moments(60);
  for (size_t i = 1; i < all.size(); i += 2) all[i] = all[i - 1];
  const LintReport report = report_of(all);
  ASSERT_EQ(report.findings.size(), 1u);
  EXPECT_EQ(report.findings[0].fault, Fault::kDuplicateFrames);
  EXPECT_GE(std::stoi(report.findings[0].evidence), 20) << report.findings[0].evidence;
}

TEST(FrameTrace, APictureThatIsHeldIsNoDuplicate) {
  std::vector<Moment> all = moments(60);
  for (size_t i = 20; i < 35; i++) all[i] = all[19];
  for (size_t i = 56; i < 60; i++) all[i] = all[55];
  const LintReport report = report_of(all);
  EXPECT_TRUE(report.findings.empty()) << report.findings[0].evidence;
  EXPECT_TRUE(judged(report, Check::kDuplicates));
}

// A lamp that is switched every third frame.
TEST(FrameTrace, LightIsNoMotion) {
  const LintReport report = report_of(60, [](int i, std::vector<std::byte>& luma) {
    for (const int eye : {0, 1}) draw(luma, {{7, 7}}, eye);
    const int percent = i / 3 % 2 == 0 ? 100 : 60;
    for (std::byte& value : luma) value = static_cast<std::byte>(static_cast<int>(value) * percent / 100);
  });
  EXPECT_TRUE(report.findings.empty()) << report.findings[0].evidence;
}

TEST(FrameTrace, AStillPictureHasNoDuplicates) {
  const LintReport report = report_of(std::vector<Moment>(60, Moment{{7, 7}}));
  EXPECT_TRUE(report.findings.empty());
  EXPECT_FALSE(judged(report, Check::kDuplicates));
  EXPECT_FALSE(judged(report, Check::kEyeTime));
}

TEST(FrameTrace, FindsCutsOfOneEye) {
  std::vector<Moment> all = moments(60);
  for (size_t i = 30; i < all.size(); i++) all[i].shot[0] = all[i].shot[1] = 1;
  const LintReport together = report_of(all);
  EXPECT_TRUE(judged(together, Check::kCuts));
  EXPECT_TRUE(together.findings.empty()) << together.findings[0].evidence;
  all[30].shot[1] = all[31].shot[1] = 0;
  const LintReport apart = report_of(all);
  ASSERT_EQ(apart.findings.size(), 1u);  // nor is the eye late: its motion is not
  EXPECT_EQ(apart.findings[0].fault, Fault::kCutsDiffer);
  const std::string evidence = apart.findings[0].evidence;
  EXPECT_NE(evidence.find("left eye at 1.20 s (frame 30), right eye at 1.28 s (frame 32)"), std::string::npos)
      << evidence;
}

}  // namespace
}  // namespace ods
