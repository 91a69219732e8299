// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/sequence/render_video.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "ods/base/error.h"
#include "ods/scene/load/load.h"
#include "ods/sequence/identity.h"
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
    options.scene = scene_settings("toys");
    options.camera.move.turns = 0.1;
    options.shutter = 90.0;
    options.render.width = 32;
    options.render.samples = 4;
    video.frames = {0, 1, 2, 3};
    video.encode.rate = {10, 1};
  }

  void make(const std::string& name, const Progress& progress = {}) {
    Scene scene = load_scene("toys");
    play(scene.animation, "");
    render_video(scene, options, video, folder.path(name), progress);
  }
  // The message with which the library refuses to.
  std::string refusal(const std::string& name) {
    try {
      make(name);
    } catch (const Error& error) {
      EXPECT_TRUE(error.kind() == ErrorKind::kUsage);
      return error.what();
    }
    return "";
  }
  std::string frame(const std::string& name, int number) const {
    return folder.read(name + ".frames/frame.00000" + std::to_string(number) + ".exr");
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
  film.options.render.samples = 8;
  const std::string why = film.refusal("a.mp4");
  EXPECT_NE(why.find("`samples` was 4, now 8; `restart` discards it and starts over"), std::string::npos) << why;
  film.video.restart = true;
  film.video.keep_frames = false;
  film.make("a.mp4");
  EXPECT_FALSE(film.has_frames("a.mp4"));
}

// Toys whose noise is judged: with more light shown, pixels stop later.
struct JudgedFilm : Film {
  JudgedFilm() {
    options.render.samples = 512;
    options.render.noise = 0.03f;
    options.finish.denoiser = Denoiser::kNone;
    video.frames = {1};
    video.keep_frames = true;
  }
};

TEST(RenderVideo, FramesForTwoExposuresAreNotMixed) {
  JudgedFilm film;
  film.options.exposure = -6.0f;
  film.make("a.mp4");
  film.make("same.mp4");
  EXPECT_EQ(film.frame("a.mp4", 1), film.frame("same.mp4", 1));
  film.options.exposure = 4.0f;
  film.make("b.mp4");
  EXPECT_NE(film.frame("a.mp4", 1), film.frame("b.mp4", 1)) << "the exposure makes another frame";
  const std::string why = film.refusal("a.mp4");
  EXPECT_NE(why.find("`exposure` was -6, now 4; "), std::string::npos) << why;
  // If noise is not judged by it, the exposure belongs to the video alone.
  film.options.render.noise = 0.0f;
  film.options.render.samples = 4;
  film.make("c.mp4");
  const std::string frame = film.frame("c.mp4", 1), video = film.folder.read("c.mp4");
  film.options.exposure = -6.0f;
  film.make("c.mp4");
  EXPECT_EQ(film.frame("c.mp4", 1), frame);
  EXPECT_NE(film.folder.read("c.mp4"), video);
}

TEST(RenderVideo, StopsAreAddedToEveryExposure) {
  JudgedFilm film;
  film.options.render.width = 16;
  const auto look = [&](std::optional<float> given, float brighter, bool as_painted = false) {
    Scene scene = load_scene("axis");
    scene.as_painted = as_painted;
    film.options.exposure = given;
    film.options.brighter = brighter;
    FrameRenderer renderer(film.options, scene);
    const FirstLook found = look_first(renderer, make_frames(film.options, {0}, film.folder.path("#.exr")));
    EXPECT_EQ(renderer.options().render.noise_exposure, found.exposure);
    return found;
  };
  EXPECT_EQ(look(0.5f, 1.5f).exposure, 2.0f);
  EXPECT_EQ(look({}, 1.5f, true).exposure, 1.5f) << "a scene that is shown as painted";
  const FirstLook chosen = look({}, 0.0f), brighter = look({}, 1.5f);
  EXPECT_EQ(brighter.chosen, chosen.exposure);
  EXPECT_FLOAT_EQ(brighter.exposure, chosen.exposure + 1.5f);
}

// The camera comes down from the sky: what suits all frames is not what suits the first.
TEST(RenderVideo, AddedFramesAreMadeWithWhatTheFirstLookHasFound) {
  JudgedFilm film;
  film.options.render.width = 16;
  film.options.render.samples = 4;
  film.options.fps = 10.0;
  film.options.merge_limit = 20.0f;
  film.options.camera.position = vec3(0.0f, 40.0f, 0.0f);
  film.options.camera.move = {1.0, 0.0, {}, {vec3(0.0f, 0.3f, 0.0f)}};
  struct Found {
    float exposure = 0.0f;
    std::vector<float> merge;
    ExposureReason reason = ExposureReason::kKnown;
    bool operator==(const Found&) const = default;
  };
  const auto make = [&] {
    Found found;
    VideoProgress progress;
    progress.start = [&](const VideoStart& start) {
      const SequenceOptions& options = start.renderer.options();
      found = {options.render.noise_exposure, options.camera.stereo.merge_map->pixels, start.look.reason};
    };
    Scene scene = load_scene("toys");
    VideoJournal journal(film.folder.path("a.mp4"), frame_identity(film.options), film.video.restart);
    render_video(journal, scene, film.options, film.video, progress);
    return found;
  };
  film.video.frames = {0};
  Found first = make();
  EXPECT_EQ(first.reason, ExposureReason::kLight);
  film.video.frames = {0, 10};
  first.reason = ExposureReason::kRecorded;
  EXPECT_EQ(make(), first);
  film.video.restart = true;
  const Found both = make();
  EXPECT_NE(both.exposure, first.exposure) << "else this test shows nothing";
  EXPECT_NE(both.merge, first.merge) << "else this test shows nothing";
}

// Noise, shutter and the neighbours of a frame are the same for the library and the command.
// Two processes that share the frames opened the journal before either had looked.
TEST(RenderVideo, TheFirstOfTwoProcessesDecides) {
  const TemporaryFolder folder;
  const Settings settings = {{"`exposure`", std::string(kByFirstLook), ""}};
  VideoJournal first(folder.path("a.mp4"), settings, false, JournalUse::kShared);
  VideoJournal second(folder.path("a.mp4"), settings, false, JournalUse::kShared);
  first.record("`exposure`", "1.5");
  second.plan({1, 2}, {1});
  EXPECT_EQ(second.found("`exposure`"), "1.5");
  second.record("`exposure`", "1.4");
  const VideoJournal third(folder.path("a.mp4"), settings, false, JournalUse::kShared);
  EXPECT_EQ(third.found("`exposure`"), "1.5");
}

TEST(RenderVideo, AFrameAloneIsThatOfTheWholeSequence) {
  Film film;
  const auto render = [&](const std::string& name, const std::vector<size_t>& missing) {
    Scene scene = load_scene("toys");
    play(scene.animation, "");
    FrameRenderer renderer(film.options, scene);
    const std::vector<SequenceFrame> all =
        make_frames(film.options, film.video.frames, film.folder.path(name + ".####.exr"));
    EXPECT_EQ(render_sequence(renderer, all, missing, Sink::kShared), missing.size());
    return film.folder.read(name + ".0002.exr");
  };
  EXPECT_EQ(render("all", {0, 1, 2, 3}), render("one", {2}));
  film.options.draws_on_neighbours = false;
  EXPECT_NE(render("alone", {2}), film.folder.read("one.0002.exr")) << "its neighbours take part";
}

TEST(RenderVideo, APatternNeedsAPlaceForNumbers) {
  const SequenceOptions options{};
  EXPECT_THROW(make_frames(options, {1}, "frame.exr"), Error);
}

}  // namespace
}  // namespace ods
