// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Differences between the eyes other than parallax: the right eye of a correct pair is misaligned, tinted, blurred. The
// correction that lint suggests is the inverse of the change, and its remedy makes a picture without that fault.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "ods/convert/convert.h"
#include "ods/image/tone.h"
#include "ods/lint/lint.h"
#include "ods/picture/save.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/builtin/builtin.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

constexpr int kWidth = 768;

const Picture& scene_picture() {
  static const Picture picture = [] {
    const Scene scene = find_builtin("toys")->make();
    StereoCamera camera;
    camera.position = default_view(scene).position;
    RenderOptions options;
    options.width = kWidth, options.samples = 2, options.bounces = 1, options.layers = false;
    return render_cpu(scene, camera, options);
  }();
  return picture;
}

class LintEyes : public ::testing::Test {
 protected:
  // The scene, whose right eye needs the inverse of this. As a PNG.
  std::string make(const EyeCorrection& wrong, const std::string& name) {
    SaveOptions save;
    save.tone = ToneCurve::kLinear;
    save_picture(scene_picture(), save, folder.path("scene_TB.png"));
    return corrected(folder.path("scene_TB.png"), wrong, name);
  }

  std::string corrected(const std::string& from, const EyeCorrection& correction, const std::string& name) {
    const StoredPicture picture = open_picture(from);
    ConvertTarget target = same_format(picture);
    target.right = correction;
    SaveOptions save;
    save.tone = ToneCurve::kLinear, save.layout = picture.layout;
    save_picture(convert(picture, target).rows, nullptr, save, folder.path(name));
    return folder.path(name);
  }

  TemporaryFolder folder;
};

std::set<Fault> faults_of(const LintReport& report) {
  std::set<Fault> faults;
  for (const Finding& finding : report.findings) {
    if (finding.certainty >= 0.5 && severity_of(finding.fault) == Severity::kFault) faults.insert(finding.fault);
  }
  return faults;
}

Finding finding_of(const LintReport& report, Fault fault) {
  for (const Finding& finding : report.findings) {
    if (finding.fault == fault) return finding;
  }
  return {};
}

std::string remedy_of(const LintReport& report, Fault fault) {
  return finding_of(report, fault).remedy;
}

// The numbers after an option of a command.
float number_after(const std::string& text, const std::string& option) {
  const size_t at = text.find(option + " ");
  return at == std::string::npos ? NAN : std::stof(text.substr(at + option.size() + 1));
}

TEST_F(LintEyes, OfACorrectPairAreJudgedAndHaveNoFault) {
  const LintReport report = lint(make({}, "right_TB.png"));
  EXPECT_EQ(faults_of(report), std::set<Fault>{});
  for (const Check check : {Check::kAlignment, Check::kColors, Check::kSharpness}) {
    EXPECT_EQ(std::count(report.judged.begin(), report.judged.end(), check), 1) << check_name(check);
  }
}

struct Misalignment {
  float EyeCorrection::*field;
  float amount;
  Fault fault;
  const char* option;
};

TEST_F(LintEyes, ThatAreMisalignedAreFoundAndFixed) {
  for (const Misalignment& wrong : {Misalignment{&EyeCorrection::raise, 0.7f, Fault::kVerticalOffset, "`right-raise`"},
                                    Misalignment{&EyeCorrection::raise, -5.0f, Fault::kVerticalOffset, "`right-raise`"},
                                    Misalignment{&EyeCorrection::pitch, 1.5f, Fault::kEyePitched, "`right-pitch`"},
                                    Misalignment{&EyeCorrection::roll, -10.0f, Fault::kEyeRolled, "`right-roll`"},
                                    Misalignment{&EyeCorrection::roll, 1.0f, Fault::kEyeRolled, "`right-roll`"}}) {
    EyeCorrection made;
    made.*wrong.field = wrong.amount;
    const LintReport report = lint(make(made, "wrong_TB.png"));
    SCOPED_TRACE(fmt::format("{} {}", wrong.option, wrong.amount));
    EXPECT_EQ(faults_of(report), std::set<Fault>{wrong.fault});
    const std::string remedy = remedy_of(report, wrong.fault);
    EXPECT_NE(remedy.find("ods convert "), std::string::npos) << remedy;
    const float needed = number_after(remedy, wrong.option);
    EXPECT_NEAR(needed, -wrong.amount, 0.06f) << remedy;
    EyeCorrection fixed;
    fixed.*wrong.field = needed;
    EXPECT_EQ(faults_of(lint(corrected(folder.path("wrong_TB.png"), fixed, "fixed_TB.png"))), std::set<Fault>{});
  }
}

TEST_F(LintEyes, ThatDifferInSizeAreFound) {
  EyeCorrection made;
  made.zoom = 1.03f;
  const LintReport report = lint(make(made, "larger_TB.png"));
  EXPECT_EQ(faults_of(report), std::set<Fault>{Fault::kEyeMagnified});
  EXPECT_NEAR(number_after(remedy_of(report, Fault::kEyeMagnified), "`right-zoom`"), 1.0f / 1.03f, 0.003f);
}

// Far things in this scene have hardly any parallax.
TEST_F(LintEyes, ThatMustDivergeAreFoundAndFixed) {
  for (const float amount : {-0.6f, -3.0f}) {
    EyeCorrection made;
    made.yaw = amount;
    const LintReport report = lint(make(made, "wide_TB.png"));
    EXPECT_EQ(faults_of(report), std::set<Fault>{Fault::kEyesDiverge}) << amount;
    EyeCorrection fixed;
    fixed.yaw = number_after(remedy_of(report, Fault::kEyesDiverge), "`right-yaw`");
    EXPECT_NEAR(fixed.yaw, -amount, 0.15f);
    EXPECT_EQ(faults_of(lint(corrected(folder.path("wide_TB.png"), fixed, "fixed_TB.png"))), std::set<Fault>{});
  }
  EyeCorrection inwards;
  inwards.yaw = 1.5f;
  EXPECT_EQ(faults_of(lint(make(inwards, "near_TB.png"))), std::set<Fault>{});
}

TEST_F(LintEyes, ThatSeeNothingAreFound) {
  EyeCorrection dark;
  dark.gain = vec3(0.001f);
  const LintReport report = lint(make(dark, "dark_TB.png"));
  EXPECT_EQ(faults_of(report).count(Fault::kBlack), 1u);
  EXPECT_NE(finding_of(report, Fault::kBlack).evidence.find("the right eye"), std::string::npos);
}

// Swapped eyes that are rolled as well are both.
TEST_F(LintEyes, ThatAreMisalignedAreJudgedAsIfTheyWereNot) {
  EyeCorrection made;
  made.roll = 4.0f;
  const StoredPicture picture = open_picture(make(made, "rolled_TB.png"));
  SaveOptions save;
  save.tone = ToneCurve::kLinear, save.layout = Layout::kBottomTop;
  save_picture(convert(picture, same_format(picture)).rows, nullptr, save, folder.path("both_TB.png"));
  EXPECT_EQ(faults_of(lint(folder.path("both_TB.png"))), (std::set<Fault>{Fault::kRightOnTop, Fault::kEyeRolled}));
}

TEST_F(LintEyes, OfOtherColoursAreFoundAndFixed) {
  EyeCorrection tinted;
  tinted.gain = vec3(0.9f, 1.0f, 1.0f);
  const LintReport tint = lint(make(tinted, "tinted_TB.png"));
  EXPECT_EQ(faults_of(tint), std::set<Fault>{Fault::kEyeTinted});
  const std::string remedy = remedy_of(tint, Fault::kEyeTinted);
  EXPECT_NEAR(number_after(remedy, "`right-gain`"), 1.0f / 0.9f, 0.02f) << remedy;

  EyeCorrection darker;
  darker.gain = vec3(std::exp2(-0.3f));
  const LintReport exposure = lint(make(darker, "darker_TB.png"));
  EXPECT_EQ(faults_of(exposure), std::set<Fault>{Fault::kEyeBrighter});
  EXPECT_NEAR(number_after(remedy_of(exposure, Fault::kEyeBrighter), "`right-gain`"), std::exp2(0.3f), 0.03f);

  EyeCorrection power;
  power.gamma = 1.15f;
  const LintReport gamma = lint(make(power, "gamma_TB.png"));
  EXPECT_EQ(faults_of(gamma).count(Fault::kEyeGamma), 1u);
  EXPECT_NEAR(number_after(remedy_of(gamma, Fault::kEyeGamma), "`right-gamma`"), 1.0f / 1.15f, 0.02f);
}

TEST_F(LintEyes, OfWhichOneIsBlurredAreFound) {
  Image packed = read_image(make({}, "sharp_TB.png"));
  const Image sharp = packed;
  for (int y = kWidth / 2 + 2; y + 2 < kWidth; y++) {
    for (int x = 0; x < kWidth; x++) {
      for (int c = 0; c < 3; c++) {
        float sum = 0.0f;
        for (int i = 0; i < 25; i++) sum += sharp.at((x + i % 5 - 2 + kWidth) % kWidth, y + i / 5 - 2)[c];
        packed.at(x, y)[c] = sum / 25.0f;
      }
    }
  }
  SaveOptions save;
  save.tone = ToneCurve::kLinear;
  save_picture({{{kMono, packed, {}, {}, {}}}}, save, folder.path("blurred_TB.png"));
  const LintReport report = lint(folder.path("blurred_TB.png"));
  EXPECT_EQ(faults_of(report), std::set<Fault>{Fault::kEyeBlurred});
  EXPECT_NE(finding_of(report, Fault::kEyeBlurred).evidence.find("the right eye"), std::string::npos);
}

}  // namespace
}  // namespace ods
