// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults that one eye shows alone: posts under a sky, tilted, with holes at the poles, too bright, with too few code
// values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "ods/camera/eye_correction.h"
#include "ods/image/tone.h"
#include "ods/lint/lint.h"
#include "ods/picture/save.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/waves.h"

namespace ods::one_eye_test {

constexpr Extent kUsual{1024, 512};
constexpr float kPi2 = 6.2831853f;

class LintOneEye : public ::testing::Test {
 protected:
  LintReport lint_of(const std::function<vec3(vec3 direction)>& shown, Extent size = kUsual) const {
    Image image(size.width, size.height, 3);
    const Projection sphere = make_projection({});
    for (int y = 0; y < size.height; y++) {
      for (int x = 0; x < size.width; x++) {
        const vec2 uv = (vec2(x, y) + 0.5f) / vec2(size.width, size.height);
        const vec3 code = shown(look_of(sphere, uv, uv).direction);
        for (int c = 0; c < 3; c++) image.at(x, y)[c] = srgb_decode(std::clamp(code[c], 0.0f, 1.0f));
      }
    }
    SaveOptions save;
    save.tone = ToneCurve::kLinear;
    save_picture({{{kMono, image, {}, {}, {}}}}, save, folder.path("eye.png"));
    return lint(folder.path("eye.png"));
  }

  Waves world;
  TemporaryFolder folder;
};

const Finding* finding_of(const LintReport& report, Fault fault) {
  const auto is_it = [&](const Finding& finding) { return finding.fault == fault && finding.certainty >= 0.5; };
  const auto found = std::find_if(report.findings.begin(), report.findings.end(), is_it);
  return found == report.findings.end() ? nullptr : &*found;
}

bool judged(const LintReport& report, Check check) {
  return std::count(report.judged.begin(), report.judged.end(), check) == 1;
}

// Soft-edged posts all around, between elevations of 50 degrees.
vec3 posts(vec3 d) {
  const float theta = std::atan2(d.x, -d.z), phi = std::asin(std::clamp(d.y, -1.0f, 1.0f));
  const float post = std::clamp(0.5f + 10.0f * std::sin(24.0f * theta), 0.0f, 1.0f);
  return std::abs(phi) < 0.87f ? vec3(0.3f + 0.4f * post) : vec3(0.5f + 0.1f * d.y);
}

TEST_F(LintOneEye, WithVerticalPostsIsLevelOrNot) {
  const LintReport level = lint_of(posts);
  EXPECT_TRUE(judged(level, Check::kHorizon));
  EXPECT_EQ(finding_of(level, Fault::kNotLevel), nullptr);
  EyeCorrection tilt;
  tilt.pitch = 3.0f, tilt.roll = 4.0f;
  const LintReport tilted = lint_of([&](vec3 d) { return posts(stored_direction(tilt, d)); });
  const Finding* found = finding_of(tilted, Fault::kNotLevel);
  ASSERT_NE(found, nullptr);
  const size_t at = found->remedy.find("`pitch` ");
  ASSERT_NE(at, std::string::npos) << found->remedy;
  float pitch = 0.0f, roll = 0.0f;
  ASSERT_EQ(std::sscanf(found->remedy.c_str() + at, "`pitch` %f `roll` %f", &pitch, &roll), 2) << found->remedy;
  EXPECT_NEAR(pitch, -3.0f, 0.3f);
  EXPECT_NEAR(roll, -4.0f, 0.3f);
}

TEST_F(LintOneEye, WithoutLinesIsNotJudgedToBeLevel) {
  EXPECT_FALSE(judged(lint_of([&](vec3 d) { return vec3(world(d)); }), Check::kHorizon));
}

// A level room of 256 pixels around was found tilted by 14 degrees.
TEST_F(LintOneEye, OfFewPixelsIsNotJudgedToBeLevel) {
  EXPECT_FALSE(judged(lint_of(posts, {256, 128}), Check::kHorizon));
}

TEST_F(LintOneEye, HasDeadPolesOrNot) {
  const auto shown = [&](vec3 d) { return vec3(0.2f + 0.6f * world(d)); };
  EXPECT_EQ(finding_of(lint_of(shown), Fault::kDeadPole), nullptr);
  const float edge = -std::cos(10.0f * kPi2 / 360.0f);
  const LintReport report = lint_of([&](vec3 d) { return d.y < edge ? vec3(0.0f) : shown(d); });
  const Finding* found = finding_of(report, Fault::kDeadPole);
  ASSERT_NE(found, nullptr);
  EXPECT_NE(found->evidence.find("9.8 degrees radius at the bottom"), std::string::npos) << found->evidence;
  // A night without stars over a world that does not end at one elevation.
  const LintReport night = lint_of([&](vec3 d) { return d.y > 0.9f - 0.1f * d.x ? vec3(0.0f) : shown(d); });
  EXPECT_EQ(finding_of(night, Fault::kDeadPole), nullptr);
}

TEST_F(LintOneEye, HasClippedHighlightsOrNot) {
  const auto shown = [&](vec3 d) { return vec3(0.8f * world(d)); };
  EXPECT_EQ(finding_of(lint_of(shown), Fault::kClipped), nullptr);
  // A cap with 5 % of the sphere: 1 - cos(radius) = 0.1.
  const LintReport report = lint_of([&](vec3 d) { return -d.z > 0.9f ? vec3(1.0f) : shown(d); });
  const Finding* found = finding_of(report, Fault::kClipped);
  ASSERT_NE(found, nullptr);
  EXPECT_NE(found->evidence.find("5.0 % of the picture"), std::string::npos) << found->evidence;
}

TEST_F(LintOneEye, HasBandsOrNot) {
  const auto sky = [](vec3 d) { return vec3(0.5f + 0.3f * d.y, 0.5f + 0.2f * d.y, 0.6f + 0.3f * d.y); };
  EXPECT_EQ(finding_of(lint_of(sky), Fault::kBanding), nullptr);
  const LintReport report = lint_of([&](vec3 d) { return floor(sky(d) * 32.0f) / 32.0f; });
  EXPECT_NE(finding_of(report, Fault::kBanding), nullptr);
  EXPECT_TRUE(judged(report, Check::kBanding));
}

// Noise cuts slopes into runs that are not stairs: none of them is level.
TEST_F(LintOneEye, ANoisyGlowHasNoBands) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> noise(-0.004f, 0.004f);
  const LintReport report =
      lint_of([&](vec3 d) { return vec3(0.3f + 0.25f * d.y + 0.2f * d.x) * (1.0f + noise(engine)); });
  const Finding* found = finding_of(report, Fault::kBanding);
  EXPECT_EQ(found, nullptr) << found->evidence;
}

}  // namespace ods::one_eye_test
