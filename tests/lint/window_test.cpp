// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Flat stereo pictures are judged as windows: they have no fault of spheres.
#include <gtest/gtest.h>

#include "ods/lint/lint.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/unknown_files.h"

namespace ods::window_test {

class LintWindow : public testing::Test {
 protected:
  LintReport lint_of(const std::string& name, std::optional<Layout> layout) const {
    const TwoEyes eyes = [](int eye, const ProjectionSetting& projection, Extent size) {
      StereoCamera camera;
      camera.projection = projection;
      return seen_in(World::kHall, camera, eye, size, true);
    };
    write_unknown(folder.path(name), {layout, find_projection("perspective")->setting}, eyes, {640, 480});
    return lint(folder.path(name));
  }

  static void expect_no_fault(const LintReport& report) {
    EXPECT_EQ(report.projection, "perspective") << report.reason;
    for (const Finding& finding : report.findings) {
      EXPECT_FALSE(severity_of(finding.fault) == Severity::kFault && finding.certainty >= 0.5)
          << fault_name(finding.fault) << ": " << finding.evidence << "; " << finding.remedy;
    }
  }

  TemporaryFolder folder;
};

TEST_F(LintWindow, OfTwoEyesHasNoFaultOfSpheres) {
  for (const char* name : {"holiday_LR.jpg", "holiday.jpg"}) {
    const LintReport report = lint_of(name, Layout::kSideBySide);
    EXPECT_EQ(report.layout, Layout::kSideBySide) << name;
    expect_no_fault(report);
  }
}

TEST_F(LintWindow, WithSwappedEyesHasThatFault) {
  const LintReport report = lint_of("holiday_LR.jpg", Layout::kCrossEyed);
  EXPECT_TRUE(has_finding(report, Severity::kFault, 0.5));
  EXPECT_EQ(report.findings.at(0).fault, Fault::kEyesSwapped);
}

TEST_F(LintWindow, OfOneEyeHasNoFault) {
  expect_no_fault(lint_of("photo.jpg", std::nullopt));
}

TEST_F(LintWindow, OfAnAnaglyphHasNoFault) {
  expect_no_fault(lint_of("red_cyan.png", Layout::kAnaglyph));
}

}  // namespace ods::window_test
