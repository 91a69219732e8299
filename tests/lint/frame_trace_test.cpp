// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames in memory: bars that jump to and fro behind each other, as each eye sees them.
#include "ods/lint/frame_trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace ods {
namespace {

constexpr Extent kFrame{128, 128};
constexpr double kRate = 25.0;

// Where the bar of a time is: it walks unevenly, and begins again.
int place(int time) {
  std::mt19937 engine(3);
  int at = 20;
  for (int i = 0; i < time; i++) at += 1 + static_cast<int>(engine() % 8);
  return at % 100;
}

// The picture of an eye at a time, of a shot. The right eye sees the bar a little farther left.
void draw(std::vector<std::byte>& luma, int eye, int shot, int time) {
  for (int y = 0; y < kFrame.height / 2; y++) {
    for (int x = 0; x < kFrame.width; x++) {
      const int ground = 60 + 40 * ((x / 16 + y / 8 + shot) % 2) + (shot % 2 == 0 ? x : 120 - x);
      const int from = place(time) - 2 * eye;
      const bool is_bar = x >= from && x < from + 20 && y > 16;
      luma[static_cast<size_t>((y + eye * kFrame.height / 2) * kFrame.width + x)] =
          static_cast<std::byte>(is_bar ? ground + 40 : ground);
    }
  }
}

// The time and the shot that each eye shows in a frame.
struct Moment {
  int time[2];
  int shot[2] = {0, 0};
};

LintReport report_of(const std::vector<Moment>& moments) {
  FrameTrace trace(kFrame, Layout::kTopBottom);
  std::vector<std::byte> luma(static_cast<size_t>(kFrame.width * kFrame.height));
  for (const Moment& moment : moments) {
    for (const int eye : {0, 1}) draw(luma, eye, moment.shot[eye], moment.time[eye]);
    DecodedFrame frame;
    frame.planes.first[0] = luma.data();
    frame.planes.stride[0] = static_cast<size_t>(kFrame.width);
    trace.add(frame, trace.frames() / kRate);
  }
  EXPECT_EQ(trace.frames(), static_cast<int>(moments.size()));
  LintReport report;
  trace.report(report);
  return report;
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
    EXPECT_NE(report.findings[0].cure.find(frames), std::string::npos) << report.findings[0].cure;
  }
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
  const auto is_cut = [](const Finding& finding) { return finding.fault == Fault::kCutsDiffer; };
  const auto found = std::find_if(apart.findings.begin(), apart.findings.end(), is_cut);
  ASSERT_NE(found, apart.findings.end());
  EXPECT_NE(found->evidence.find("left eye at 1.20 s (frame 30), right eye at 1.28 s (frame 32)"), std::string::npos)
      << found->evidence;
}

}  // namespace
}  // namespace ods
