// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A film of a hall whose camera moves as it is told, cut to a cave.
#include <gtest/gtest.h>

#include <algorithm>

#include "ods/base/error.h"
#include "ods/comfort/judge_picture.h"
#include "ods/comfort/video.h"
#include "ods/image/tone.h"
#include "ods/lint/lint.h"
#include "ods/picture/save.h"
#include "ods/video/make_video.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/worlds.h"

namespace ods {
namespace {

class ComfortVideo : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_encoder("libx264")) GTEST_SKIP() << "skipped: this machine has no libx264";
  }

  // Ten frames a second. degrees: that the camera turns to the right from one to the next; metres: that it goes ahead.
  std::string make(int count, int cut, float degrees, float metres, bool stereo = true, Extent eye_size = {512, 256}) {
    SaveOptions save;
    save.tone = ToneCurve::kLinear;
    const std::string name = stereo ? "f.##_TB.png" : "f.##.png";
    Picture picture;
    for (int frame = 0; frame < count; frame++) {
      const bool is_as_before = frame > 0 && frame != cut && degrees == 0.0f && metres == 0.0f;
      StereoCamera camera;
      camera.yaw = degrees * static_cast<float>(frame);
      camera.position.z = 1.0f - metres * static_cast<float>(frame);
      const World world = frame < cut ? World::kHall : World::kCave;
      if (!is_as_before) picture.eyes.clear();
      for (const int eye : stereo ? std::vector<int>{kLeft, kRight} : std::vector<int>{kMono}) {
        if (!is_as_before) picture.eyes.push_back({eye, seen_in(world, camera, eye, eye_size), {}, {}, {}});
      }
      save_picture(picture, save, frame_names(folder.path(name))->path(frame));
    }
    const FrameFiles files = find_frames(folder.path(name));
    EncodeOptions options;
    options.packing.codec = VideoCodec::kH264;
    options.encoder = "libx264";
    options.rate = {10, 1};
    const std::string path = folder.path(stereo ? "film_360_TB.mp4" : "film_360.mp4");
    make_video(files, plan_video(files, {}, {}), {}, options, path);
    return path;
  }

  TemporaryFolder folder;
};

const VideoStrain* find(const VideoComfort& video, std::string_view name) {
  const auto found = std::ranges::find_if(video.strains, [&](const VideoStrain& each) { return each.name == name; });
  return found == video.strains.end() ? nullptr : &*found;
}

TEST_F(ComfortVideo, TurnsMovesAndCutsAreMeasured) {
  double last = 0.0;
  Progress progress;
  progress.report = [&](double done) { last = done; };
  const VideoComfort video = judge_video(make(16, 9, 4.0f, 0.04f), {}, progress);
  EXPECT_EQ(last, 1.0);
  EXPECT_EQ(video.frames, 16);
  ASSERT_EQ(video.moments.size(), 8u);
  EXPECT_NEAR(video.every, 0.2, 1e-6);
  for (const VideoMoment& moment : video.moments) EXPECT_GT(moment.matched, 0.4) << moment.seconds;
  const VideoMoment& first = video.moments[0];
  EXPECT_TRUE(first.is_carried);
  EXPECT_NEAR(first.turn, 40.0, 3.0);
  EXPECT_LT(first.tilt, 3.0);
  EXPECT_NEAR(first.speed, 0.4, 0.15);
  EXPECT_NEAR(first.nearest, 1.4, 0.25);  // the ceiling
  int cuts = 0;
  for (const VideoMoment& moment : video.moments) {
    if (!moment.cut) continue;
    cuts++;
    EXPECT_NEAR(moment.cut_at, 0.9, 1e-6);
  }
  EXPECT_EQ(cuts, 1);
  const VideoStrain* turn = find(video, "turn");
  ASSERT_NE(turn, nullptr);
  EXPECT_EQ(turn->level, ComfortLevel::kWarning);
  EXPECT_EQ(turn->from, 0.0);
  EXPECT_EQ(video.level, ComfortLevel::kError);
  ASSERT_EQ(video.worst.light.size(), 2u);
  EXPECT_EQ(video.worst.verdict.per_eye[1].levels.width, video.worst.light[1].width);
}

TEST_F(ComfortVideo, AStillCameraCarriesNobody) {
  const VideoComfort video = judge_video(make(8, 8, 0.0f, 0.0f));
  for (const VideoMoment& moment : video.moments) {
    EXPECT_LT(moment.turn, 0.5) << moment.seconds << " s, matched " << moment.matched;
    EXPECT_LT(moment.tilt, 0.5);
    EXPECT_LT(moment.speed, 0.1);
    EXPECT_FALSE(moment.cut);
  }
  EXPECT_EQ(find(video, "speed"), nullptr);
}

// However long it is, so many frames are looked at.
TEST_F(ComfortVideo, TheNumberOfFramesIsBounded) {
  VideoComfortOptions options;
  options.max_moments = 8;
  const std::string path = make(20, 20, 0.0f, 0.0f);
  EXPECT_EQ(judge_video(path, options).moments.size(), 8u);
  options.max_moments = 2;
  EXPECT_EQ(judge_video(path, options).moments.size(), 2u);
}

TEST_F(ComfortVideo, IsNotAPicture) {
  const std::string path = make(3, 3, 0.0f, 0.0f);
  EXPECT_THROW(judge_picture(path), Error);
  EXPECT_THROW(lint(path), Error);
}

TEST_F(ComfortVideo, OneEyeTellsNothing) {
  const std::string path = make(3, 3, 0.0f, 0.0f, false);
  EXPECT_THROW(judge_video(path), Error);
}

TEST_F(ComfortVideo, FewPixelsTellNothing) {
  const std::string path = make(3, 3, 0.0f, 0.0f, true, {128, 64});
  EXPECT_THROW(judge_video(path), Error);
}

}  // namespace
}  // namespace ods
