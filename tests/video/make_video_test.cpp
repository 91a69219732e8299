// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/make_video.h"

#include <gtest/gtest.h>

#include <atomic>

#include "ods/base/error.h"
#include "tests/support/made_frames.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

class MakeVideo : public ::testing::Test {
 protected:
  std::string error_of(const std::function<void()>& work) const {
    try {
      work();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  void expect_error(const std::function<void()>& work, const std::string& words) const {
    const std::string error = error_of(work);
    EXPECT_NE(error.find(words), std::string::npos) << error;
  }

  VideoPlan plan(const std::string& pattern, std::optional<Layout> layout = {}) const {
    return plan_video(find_frames(folder.path(pattern)), {}, layout);
  }

  TemporaryFolder folder;
};

TEST_F(MakeVideo, MissingFramesAreAllSaid) {
  for (int frame : {1, 2, 5, 6, 9}) folder.write("a." + std::to_string(frame) + ".png", "");
  const std::string pattern = folder.path("a.#.png");
  expect_error([&] { find_frames(pattern); }, "frames are missing: 3-4,7-8 of '" + pattern + "' (found 1-2,5-6,9)");
  expect_error([&] { find_frames(pattern, std::vector<int>{1, 2, 3, 12}); }, "missing: 3,12 of");
  std::vector<int> many;
  for (int i = 1; i <= 1000; i++) many.push_back(20 + i * i);
  expect_error([&] { find_frames(pattern, many); }, " ... (1000 in all) of '");
  EXPECT_EQ(find_frames(pattern, std::vector<int>{6, 5}).path(0), folder.path("a.6.png"));
  expect_error([&] { find_frames(folder.path("b.#.png")); }, "there is no file like");
  expect_error([&] { find_frames(folder.path("a.1.png")); }, "has no placeholder for the frame number");
  expect_error([&] { find_frames("none/a.#.png"); }, "cannot be read");
}

TEST_F(MakeVideo, MissingEyesAreSaid) {
  for (const char* name : {"left.1.png", "left.2.png", "left.3.png", "right.1.png", "right.3.png"})
    folder.write(name, "");
  const std::string pattern = folder.path("%V.#.png");
  expect_error([&] { find_frames(pattern); }, "missing: 2 of '" + folder.path("right.#.png") + "'");
  EXPECT_EQ(find_frames(pattern, std::vector<int>{3}).path(0), folder.path("%V.3.png"));
}

TEST_F(MakeVideo, FramesOfAnotherSizeAreSaid) {
  made::write_frames(folder.path("a.#.png"), {1, 2, 5});
  made::write_frames(folder.path("a.#.png"), {3, 4}, Layout::kTopBottom, {64, 32});
  expect_error([&] { plan("a.#.png"); }, "frames 3-4 of");
  expect_error([&] { plan("a.#.png"); }, "3 has 64x64 pixels, not 128x128");
}

TEST_F(MakeVideo, ThePlanIsTheFirstFrames) {
  made::write_frames(folder.path("tb.#.png"), {1, 2});
  VideoPlan tb = plan("tb.#.png");
  EXPECT_EQ(tb.size.width, 128);
  EXPECT_EQ(tb.size.height, 128);
  EXPECT_EQ(metadata_text(tb.metadata), "top-bottom, lat-long");
  EXPECT_EQ(plan("tb.#.png", Layout::kSideBySide).size.width, 256);
  made::write_frames(folder.path("views.#.exr"), {1}, Layout::kMultiview);
  EXPECT_EQ(metadata_text(plan("views.#.exr").metadata), "top-bottom, lat-long");
  made::write_frames(folder.path("vr_%V_180.#.png"), {1}, Layout::kSeparate, {64, 64});
  EXPECT_EQ(metadata_text(plan("vr_%V_180.#.png").metadata), "side-by-side, lat-long 180x180");
  made::write_frames(folder.path("half_HSBS.#.png"), {1}, Layout::kSideBySideHalf);
  const VideoPlan half = plan("half_HSBS.#.png");
  EXPECT_EQ(half.size.width, 128);
  EXPECT_EQ(metadata_text(half.metadata), "side-by-side, lat-long");
  expect_error([&] { plan("half_HSBS.#.png", Layout::kTopBottom); }, "cannot become top-bottom");
  save_picture(Picture{{{kMono, made::plain({64, 32}, vec3(99.0f)), {}, {}, {}}}}, {}, folder.path("mono.1.png"));
  EXPECT_EQ(metadata_text(plan("mono.#.png").metadata), "mono, lat-long");
}

TEST_F(MakeVideo, OtherProjectionsAreNotSaid) {
  made::write_frames(folder.path("a.#.png"), {1});
  FormatHint known;
  known.projection = find_projection("fisheye")->setting;
  known.layout = Layout::kTopBottom;
  const VideoPlan fisheye = plan_video(find_frames(folder.path("a.#.png")), known, {});
  EXPECT_FALSE(fisheye.metadata.projection);
  ASSERT_FALSE(fisheye.notes.empty());
  EXPECT_NE(fisheye.notes.back().find("has no projection"), std::string::npos);
}

TEST_F(MakeVideo, OddSidesAreRefused) {
  VideoPlan plan;
  plan.eye = {127, 64};
  expect_error([&] { check_packing(plan, {}); }, "must be even");
  plan.eye = {128, 63};
  expect_error([&] { check_packing(plan, {}); }, "must be even");
  check_packing(plan, {VideoCodec::kProRes, 10, Chroma::k422, {}});
}

// --- the video -------------------------------------------------------------------------------------------------------

class MadeVideo : public MakeVideo {
 protected:
  void SetUp() override {
    if (!has_encoder("libx264")) GTEST_SKIP() << "skipped: this machine has no libx264";
    made::write_frames(folder.path("a.#.png"), {1, 2, 3, 4, 5, 6, 7, 8, 9});
    files = find_frames(folder.path("a.#.png"));
    video = plan_video(files, {}, {});
  }

  TagResult make(const std::string& name, const Progress& progress = {}) {
    return make_video(files, video, {}, options, folder.path(name), progress);
  }

  FrameFiles files;
  VideoPlan video;
  EncodeOptions options;
};

TEST_F(MadeVideo, TwoRunsAreTheSameBytes) {
  make("one.mp4");
  make("two.mp4");
  EXPECT_EQ(folder.read("one.mp4"), folder.read("two.mp4"));
  options.threads = 1;
  make("one.mkv");
  make("two.mkv");
  EXPECT_EQ(folder.read("one.mkv"), folder.read("two.mkv"));
}

// Every encoder, and a video so small that few threads find work.
TEST_F(MadeVideo, TheNumberOfThreadsChangesNoByte) {
  made::write_frames(folder.path("small.#.png"), {1, 2, 3}, Layout::kTopBottom, {64, 32});
  const FrameFiles small = find_frames(folder.path("small.#.png"));
  const VideoPlan plan = plan_video(small, {}, {});
  for (const EncoderFacts& facts : known_encoders()) {
    if (!has_encoder(facts.name)) continue;
    options.packing.codec = facts.codec;
    options.packing.bits = facts.codec == VideoCodec::kProRes ? 10 : 8;
    options.packing.chroma = facts.codec == VideoCodec::kProRes ? Chroma::k422 : Chroma::k420;
    options.encoder = facts.name;
    std::string one, small_one;
    for (const int threads : {1, 2, 4, 7, 0}) {
      options.threads = threads;
      make("video.mkv");
      make_video(small, plan, {}, options, folder.path("small.mkv"));
      if (threads == 1) one = folder.read("video.mkv"), small_one = folder.read("small.mkv");
      EXPECT_TRUE(folder.read("video.mkv") == one) << facts.name << threads;
      EXPECT_TRUE(folder.read("small.mkv") == small_one) << facts.name << threads;
    }
  }
}

TEST_F(MadeVideo, TheHeaderComesFirst) {
  make("video.mp4");
  const std::string bytes = folder.read("video.mp4");
  EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));
  EXPECT_NE(bytes.find("nclx"), std::string::npos);
}

TEST_F(MadeVideo, ItSaysWhatItIs) {
  options.rate = {30000, 1001};
  const TagResult result = make("video.mp4");
  EXPECT_TRUE(result.has_v1);
  EXPECT_TRUE(result.has_v2);
  const VideoFile info = read_video_file(folder.path("video.mp4"));
  ASSERT_EQ(info.tracks.size(), 1u);
  EXPECT_EQ(metadata_text(*info.tracks[0].v2), "top-bottom, lat-long");
  EXPECT_NEAR(info.tracks[0].fps, 29.97, 0.001);
}

TEST_F(MadeVideo, ItSaysHowFarItsEyesAreApartWhereTheFramesDo) {
  EXPECT_EQ(video.metadata.ipd, 0.0) << "nobody knows";
  StereoCamera camera;
  camera.ipd = 0.05f;
  save_picture(made::red_and_blue({128, 64}, 1), camera, {}, folder.path("b.1.exr"));
  files = find_frames(folder.path("b.#.exr"));
  video = plan_video(files, {}, {});
  make("video.mp4");
  EXPECT_FALSE(read_video_file(folder.path("video.mp4")).tracks.at(0).vexu) << "only on request, or in HEVC";
  options.packing.codec = VideoCodec::kHevc;
  make("video.mp4");
  EXPECT_EQ(read_video_file(folder.path("video.mp4")).tracks.at(0).vexu.value().ipd, 0.05);
  options.packing.codec = VideoCodec::kH264;
  options.for_apple = true;
  make("video.mp4");
  EXPECT_EQ(read_video_file(folder.path("video.mp4")).tracks.at(0).vexu.value().ipd, 0.05);
}

TEST_F(MadeVideo, ADamagedFrameInTheMiddleLeavesNothing) {
  folder.write("video.mp4", "the old one");
  const std::string png = folder.read("a.5.png");
  folder.write("a.5.png", png.substr(0, png.size() / 2));  // its header is whole
  const size_t before = folder.names().size();
  expect_error([&] { make("video.mp4"); }, folder.path("a.5.png"));
  EXPECT_EQ(folder.read("video.mp4"), "the old one");
  EXPECT_EQ(folder.names().size(), before);
}

// Wherever the damaged one is, those that are read meanwhile go, too: the leak sanitizer is the judge.
TEST_F(MadeVideo, ADamagedFrameLeavesNoneOfTheOthersInMemory) {
  for (const char* damaged : {"a.1.png", "a.4.png", "a.9.png"}) {
    const std::string png = folder.read(damaged);
    folder.write(damaged, png.substr(0, png.size() / 2));
    for (int i = 0; i < 20; i++) {
      expect_error([&] { make("video.mp4"); }, folder.path(damaged));
    }
    folder.write(damaged, png);
  }
}

TEST_F(MadeVideo, AFrameThatChangedMeanwhileIsFound) {
  made::write_frames(folder.path("a.#.png"), {5}, Layout::kTopBottom, {64, 32});
  expect_error([&] { make("video.mp4"); }, "is not like the first frame");
}

TEST_F(MadeVideo, ItCanBeCancelledAndTellsHowFarItIs) {
  std::atomic<bool> stop{false};
  double last = 0.0;
  Progress progress;
  progress.report = [&](double done) {
    EXPECT_GT(done, last);
    last = done;
  };
  make("video.mp4", progress);
  EXPECT_EQ(last, 1.0);
  progress.report = [&](double) { stop = true; };
  progress.cancelled = [&] { return stop.load(); };
  made::write_frames(folder.path("a.#.png"), {10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20});
  files = find_frames(folder.path("a.#.png"));
  expect_error([&] { make("other.mp4", progress); }, "cancelled");
  EXPECT_EQ(folder.read("other.mp4"), "");
}

TEST_F(MadeVideo, WhatTheMachineLacksIsSaidWithWhatItHas) {
  options.packing = {VideoCodec::kAv1, 8, Chroma::k444, {}};
  options.encoder = "libsvtav1";
  expect_error([&] { check_encoder(Container::kMp4, options); }, "cannot encode av1 444: it has h264 (libx264)");
  options.packing = {VideoCodec::kH264, 8, Chroma::k420, {}};
  options.encoder = "libx264";
  options.preset = "eager";
  expect_error([&] { check_encoder(Container::kMp4, options); }, "libx264 has the presets ultrafast");
}

TEST_F(MadeVideo, SoundThatIsNoneIsRefused) {
  options.sound = folder.path("a.1.png");
  expect_error([&] { check_encoder(Container::kMp4, options); }, "cannot read the sound of");
  options.sound = folder.path("none.wav");
  expect_error([&] { check_encoder(Container::kMp4, options); }, "no such file");
  folder.write("list.wav", "#EXTM3U\nhttp://localhost/a.wav\n");
  options.sound = folder.path("list.wav");
  expect_error([&] { check_encoder(Container::kMp4, options); }, "cannot read the sound of");
}

}  // namespace
}  // namespace ods
