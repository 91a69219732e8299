// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/sequence/render_video.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "ods/base/error.h"
#include "ods/camera/camera_move.h"
#include "ods/scene/load/load.h"
#include "ods/video/container/video_file.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

// Toys that move before a camera that moves, too.
struct Film {
  TemporaryFolder folder;
  SequenceOptions options;
  VideoOptions video;

  Film() {
    options.camera = [](const Scene& scene, double seconds) {
      StereoCamera camera;
      camera.position = default_view(scene).position;
      CameraMove move;
      move.turns = 0.1;
      return moved(camera, move, seconds);
    };
    options.shutter = 90.0;
    options.render.width = 32, options.render.samples = 4;
    video.frames = {0, 1, 2, 3};
    video.encode.rate = {10, 1};
    video.settings = {{"samples", "4", ""}};
  }

  void make(const std::string& name, const Progress& progress = {}) {
    Scene scene = load_scene("toys");
    play(scene.animation, "");
    render_video(scene, options, video, folder.path(name), progress);
  }
  bool has_frames(const std::string& name) const { return std::filesystem::exists(folder.path(name) + ".frames"); }
};

TEST(RenderVideo, WritesATaggedVideoAndLeavesNothingElse) {
  Film film;
  double done = 0.0;
  const auto report = [&](double now) {
    EXPECT_GE(now, done);
    done = now;
  };
  film.make("a.mp4", {report, {}});
  EXPECT_GT(done, kRenderingShare);
  EXPECT_FALSE(film.has_frames("a.mp4"));
  const VideoFile file = read_video_file(film.folder.path("a.mp4"));
  ASSERT_EQ(file.tracks.size(), 1u);
  EXPECT_EQ(file.tracks[0].size.width, 32);
  EXPECT_EQ(file.tracks[0].size.height, 32) << "two eyes, one above the other";
}

TEST(RenderVideo, GoesOnAfterAnInterruptionWithTheSameBytes) {
  Film film;
  film.make("whole.mp4");
  double done = 0.0;
  try {
    film.make("broken.mp4", {[&](double now) { done = now; }, [&] { return done > 0.6; }});
    FAIL() << "was not stopped";
  } catch (const Error& error) {
    EXPECT_TRUE(error.kind() == ErrorKind::kCancelled) << error.what();
  }
  EXPECT_TRUE(film.has_frames("broken.mp4"));
  EXPECT_FALSE(std::filesystem::exists(film.folder.path("broken.mp4")));
  film.make("broken.mp4");
  EXPECT_EQ(film.folder.read("broken.mp4"), film.folder.read("whole.mp4"));
  EXPECT_FALSE(film.has_frames("broken.mp4"));
}

TEST(RenderVideo, FramesOfOtherSettingsAreNotMixedIn) {
  Film film;
  film.video.keep_frames = true;
  film.make("a.mp4");
  film.video.settings = {{"samples", "8", ""}};
  try {
    film.make("a.mp4");
    FAIL() << "was not refused";
  } catch (const Error& error) {
    EXPECT_TRUE(error.kind() == ErrorKind::kUsage);
    EXPECT_NE(std::string(error.what()).find("samples was 4, now 8; `restart` discards it and starts over"),
              std::string::npos)
        << error.what();
  }
  film.video.restart = true, film.video.keep_frames = false;
  film.make("a.mp4");
  EXPECT_FALSE(film.has_frames("a.mp4"));
}

// Noise, shutter and the neighbours of a frame are the same whoever asks for it.
TEST(RenderVideo, AFrameAloneIsThatOfTheWholeSequence) {
  Film film;
  const auto render = [&](const std::string& name, const std::vector<size_t>& missing) {
    Scene scene = load_scene("toys");
    play(scene.animation, "");
    FrameRenderer renderer(film.options, scene);
    const std::vector<SequenceFrame> all =
        make_frames(film.options, film.video.frames, film.folder.path(name + ".####.exr"));
    EXPECT_EQ(render_sequence(renderer, all, missing, true), missing.size());
    return film.folder.read(name + ".0002.exr");
  };
  EXPECT_EQ(render("all", {0, 1, 2, 3}), render("one", {2}));
  film.options.draws_on_neighbours = false;
  EXPECT_NE(render("alone", {2}), film.folder.read("one.0002.exr")) << "its neighbours take part";
}

TEST(RenderVideo, APatternNeedsAPlaceForNumbers) {
  const SequenceOptions options;
  EXPECT_THROW(make_frames(options, {1}, "frame.exr"), Error);
}

}  // namespace
}  // namespace ods
