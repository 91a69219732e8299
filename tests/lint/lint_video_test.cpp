// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Videos of a world of waves, which turns from frame to frame: encoded, and judged.
#include <gtest/gtest.h>

#include <algorithm>

#include "ods/base/error.h"
#include "ods/camera/eye_correction.h"
#include "ods/image/tone.h"
#include "ods/lint/video.h"
#include "ods/picture/save.h"
#include "ods/video/make_video.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/waves.h"

namespace ods::lint_video_test {

constexpr Extent kEye{512, 256};

// The view of an eye: 3 degrees of parallax everywhere, after so many degrees of turning.
Image view(const Waves& world, int eye, float turned, const EyeCorrection& stored) {
  Image image(kEye.width, kEye.height, 3);
  const Projection sphere = make_projection({});
  for (int y = 0; y < kEye.height; y++) {
    for (int x = 0; x < kEye.width; x++) {
      const vec2 uv((static_cast<float>(x) + 0.5f) / kEye.width, (static_cast<float>(y) + 0.5f) / kEye.height);
      vec3 d = look_of(sphere, uv, uv).direction;
      if (eye == kRight) d = stored_direction(stored, d);
      EyeCorrection turn;
      turn.yaw = turned + (eye == kRight ? 1.5f : -1.5f);
      const float shown = world(stored_direction(turn, d));
      std::fill_n(image.at(x, y), 3, srgb_decode(std::clamp(shown, 0.0f, 1.0f)));
    }
  }
  return image;
}

class LintVideo : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_encoder("libx264")) GTEST_SKIP() << "skipped: this machine has no libx264";
  }

  // The right eye is higher by so many degrees, from a frame on.
  std::string make(int count, float higher, int from) {
    make_frames(count, higher, from);
    return encode();
  }

  void make_frames(int count, float higher, int from) {
    const Waves world;
    SaveOptions save;
    save.tone = ToneCurve::kLinear;
    for (int frame = 0; frame < count; frame++) {
      Picture picture;
      EyeCorrection stored;
      if (frame >= from) stored.raise = higher;
      const float turned = (frame >= from ? 100.0f : 0.0f) + 0.3f * static_cast<float>(frame);
      for (const int eye : {kLeft, kRight}) picture.eyes.push_back({eye, view(world, eye, turned, stored), {}, {}, {}});
      save_picture(picture, save, frame_names(folder.path("f.##_TB.png"))->path(frame));
    }
  }

  std::string encode(std::optional<int> quality = {}) {
    const FrameFiles files = find_frames(folder.path("f.##_TB.png"));
    EncodeOptions options;
    options.packing.codec = VideoCodec::kH264;
    options.encoder = "libx264";
    options.packing.quality = quality;
    options.rate = {10, 1};
    make_video(files, plan_video(files, {}, {}), {}, options, folder.path("film_360_TB.mp4"));
    return folder.path("film_360_TB.mp4");
  }

  TemporaryFolder folder;
};

bool judged(const LintReport& report, Check check) {
  return std::count(report.judged.begin(), report.judged.end(), check) == 1;
}

TEST_F(LintVideo, FindsAFaultOfAShotAndItsTimes) {
  const std::string path = make(20, 2.0f, 10);
  double last = 0.0;
  Progress progress;
  progress.report = [&](double done) { last = done; };
  const LintReport report = lint_video(path, {{}, 2}, progress);
  EXPECT_EQ(report.frames, 20);
  EXPECT_EQ(report.judged_frames, 10);
  EXPECT_EQ(last, 1.0);
  EXPECT_TRUE(judged(report, Check::kAlignment));
  EXPECT_TRUE(judged(report, Check::kCuts));
  const auto is_offset = [](const Finding& finding) { return finding.fault == Fault::kVerticalOffset; };
  const auto found = std::find_if(report.findings.begin(), report.findings.end(), is_offset);
  ASSERT_NE(found, report.findings.end());
  EXPECT_GT(found->certainty, 0.5);
  EXPECT_EQ(found->times, (std::vector<double>{1.0, 1.2, 1.4, 1.6, 1.8}));
  EXPECT_NE(found->remedy.find("`right-raise` -2.0"), std::string::npos) << found->remedy;
  for (const Check check : kChecks) {
    const bool skipped = std::any_of(report.not_judged.begin(), report.not_judged.end(),
                                     [&](const NotJudged& each) { return each.check == check; });
    EXPECT_NE(judged(report, check), skipped) << check_name(check);
  }
}

// With few bits a codec breaks the picture where it closes.
TEST_F(LintVideo, ASeamNeedsBits) {
  make_frames(8, 0.0f, 8);
  const auto has_few_bits = [&](int quality) {
    const LintReport report = lint_video(encode(quality));
    return std::any_of(report.not_judged.begin(), report.not_judged.end(), [](const NotJudged& each) {
      return each.check == Check::kSeam && each.reason.find("so few bits") != std::string::npos;
    });
  };
  EXPECT_TRUE(has_few_bits(51));
  EXPECT_FALSE(has_few_bits(5));
}

TEST_F(LintVideo, StopsWhenItIsAskedTo) {
  const std::string path = make(3, 0.0f, 3);
  Progress progress;
  progress.cancelled = [] { return true; };
  EXPECT_THROW(lint_video(path, {}, progress), Error);
  EXPECT_THROW(lint_video(folder.path("f.00_TB.png")), Error);
}

}  // namespace ods::lint_video_test
