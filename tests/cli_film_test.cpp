// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods film as its users meet it: one command, and what becomes of it when it is killed.
#include <filesystem>
#include <random>
#include <thread>

#include "ods/video/encode.h"
#include "tests/cli_runner.h"

namespace {

class Film : public Cli {
 protected:
  void SetUp() override {
    if (!ods::has_encoder("libx264")) GTEST_SKIP() << "skipped: this machine has no libx264";
  }

  std::string words(const std::string& name, const std::string& more = "") const {
    return "film toys --width 32 --samples 1 --frames 1-4 -o " + folder.path(name) + " " + more;
  }
};

TEST_F(Film, OneCommandMakesATaggedFilmAndCleansUp) {
  ASSERT_EQ(run(words("film_360_TB.mp4", "--fps 25")), 0) << err;
  EXPECT_EQ(out, folder.path("film_360_TB.mp4") + "\n");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"film_360_TB.mp4"});
  const ods::FilmInfo film = ods::read_film(folder.path("film_360_TB.mp4"));
  ASSERT_EQ(film.video.size(), 1u);
  EXPECT_EQ(form_text(*film.video[0].v1), "top-bottom, lat-long");
  EXPECT_EQ(form_text(*film.video[0].v2), "top-bottom, lat-long");
  EXPECT_EQ(film.video[0].fps, 25.0);
  EXPECT_EQ(film.video[0].size.height, 32);
}

TEST_F(Film, FormsOfFrames) {
  ASSERT_EQ(run(words("a_180_LR.mkv", "--projection vr180")), 0) << err;
  EXPECT_EQ(form_text(*ods::read_film(folder.path("a_180_LR.mkv")).video[0].v2), "side-by-side, lat-long 180x180");
  ASSERT_EQ(run(words("b_360.mp4", "--eyes mono --noise changing --turntable 1")), 0) << err;
  EXPECT_EQ(form_text(*ods::read_film(folder.path("b_360.mp4")).video[0].v2), "mono, lat-long");
}

// The words that mislead go; those of what is written come.
TEST_F(Film, ANameThatPlayersUnderstandIsProposed) {
  const std::tuple<const char*, const char*, const char*> kCases[] = {
      {"a_180.mp4", "", "a_360_TB.mp4"},
      {"a_180_LR.mp4", "", "a_360_TB.mp4"},
      {"a_LR_180.mp4", "--layout side-by-side", "a_360_LR.mp4"},
      {"a_360.mp4", "--projection vr180", "a_180_LR.mp4"},
      {"a_360_TB.mp4", "--eyes mono", "a_360.mp4"},
      {"a.mp4", "", "a_360_TB.mp4"},
      {"a_360_TB.mp4", "", ""},
      {"a_TB.mp4", "", ""},
      {"a_180_LR.mp4", "--projection vr180", ""},
      {"a.mp4", "--eyes mono --noise changing --turntable 1", ""},
  };
  for (const auto& [name, options, proposed] : kCases) {
    ASSERT_EQ(run(words(name, options)), 0) << err;
    const size_t at = err.find("would know it as ");
    if (!*proposed) {
      EXPECT_EQ(at, std::string::npos) << name << options << err;
      continue;
    }
    ASSERT_NE(at, std::string::npos) << name << options << err;
    EXPECT_EQ(err.substr(at + 17, err.find('\n', at) - at - 17), proposed) << options;
    EXPECT_EQ(err.find("would know it as ", at + 1), std::string::npos) << "once";
    EXPECT_EQ(err.find("players differ"), err.rfind("players differ")) << "once";
  }
}

TEST_F(Film, FramesAreKeptWhereAskedAndUsedAgain) {
  ASSERT_EQ(run(words("a.mp4", "--keep-frames")), 0) << err;
  ASSERT_EQ(folder.names(), (std::vector<std::string>{"a.mp4", "a.mp4.frames"}));
  const std::string film = folder.read("a.mp4");
  // Another packing of the same frames, and more of them.
  ASSERT_EQ(run(words("a.mp4", "--keep-frames --exposure 1 --frames 1-5")), 0) << err;
  EXPECT_NE(err.find("4 of 5 frames are there already"), std::string::npos) << err;
  EXPECT_NE(folder.read("a.mp4"), film);
  ASSERT_EQ(run("encode " + folder.path("a.mp4.frames/frame.######.exr") + " --codec h264 --frames 1-4 -o " +
                folder.path("b.mp4")),
            0)
      << err;
  EXPECT_EQ(folder.read("b.mp4"), film);
}

TEST_F(Film, FramesOfAnotherJobAreNotMixedIn) {
  ASSERT_EQ(run(words("a.mp4", "--keep-frames")), 0) << err;
  const std::string film = folder.read("a.mp4");
  EXPECT_EQ(run(words("a.mp4", "--samples 2")), 2);
  EXPECT_NE(err.find("--restart"), std::string::npos) << err;
  EXPECT_NE(err.find("nothing then, '--samples' now"), std::string::npos) << err;
  EXPECT_EQ(folder.read("a.mp4"), film);
  ASSERT_EQ(run(words("a.mp4", "--samples 2 --restart")), 0) << err;
  EXPECT_NE(folder.read("a.mp4"), film);
  EXPECT_EQ(files(), 1u);
  std::filesystem::create_directory(folder.path("b.mp4.frames"));
  folder.write("b.mp4.frames/diary.txt", "mine");
  EXPECT_EQ(run(words("b.mp4")), 2);
  EXPECT_EQ(run(words("b.mp4", "--restart")), 0) << err;
  EXPECT_EQ(folder.read("b.mp4.frames/diary.txt"), "mine");
}

TEST_F(Film, TheSceneIsOfTheJob) {
  ASSERT_EQ(run("render furnace --width 16 --samples 1 --eyes mono -q -o " + folder.path("sky.png")), 0) << err;
  const std::string film = words("a.mp4", "--keep-frames --env " + folder.path("sky.png"));
  ASSERT_EQ(run(film), 0) << err;
  ASSERT_EQ(run(film), 0) << err;
  EXPECT_NE(err.find("4 of 4 frames are there already"), std::string::npos) << err;
  ASSERT_EQ(run("render furnace --width 32 --samples 1 --eyes mono -q -o " + folder.path("sky.png")), 0) << err;
  EXPECT_EQ(run(film), 2);
  EXPECT_NE(err.find("sky.png ("), std::string::npos) << err;
}

// However often it is killed, wherever: at last there is the film of an undisturbed run.
TEST_F(Film, AKilledFilmGoesOnWhereItWas) {
  ASSERT_EQ(run(words("whole.mp4", "-q")), 0) << err;
  std::mt19937 random(9);
  const std::vector<std::string> job = {
      "film", "toys", "--width", "32", "--samples", "1", "--frames", "1-4", "-o", folder.path("killed.mp4"), "-q"};
  for (int i = 0; i < 8; i++) {
    Ods command(job);
    std::this_thread::sleep_for(std::chrono::milliseconds(200 + random() % 700));
    command.kill(SIGKILL);
    if (command.finish() == 0) break;
  }
  ASSERT_EQ(run(words("killed.mp4", "-q")), 0) << err;
  EXPECT_EQ(folder.read("killed.mp4"), folder.read("whole.mp4"));
  EXPECT_FALSE(std::filesystem::exists(folder.path("killed.mp4.frames")));
}

TEST_F(Film, WhatCannotBeIsSaidBeforeAnythingIsRendered) {
  const std::tuple<std::string, int, const char*> kCases[] = {
      {words("a.avi"), 2, "ends in .mp4"},
      {words("a.mp4", "--codec prores"), 2, "not prores, which goes into mov, mkv"},
      {words("a.mp4", "--layout anaglyph"), 2, "a film's layout is top-bottom or side-by-side"},
      {words("a.mp4", "--time 3"), 2, "--frames"},
      {words("a.mp4", "--width 30"), 3, "its sides are even"},
      {words("a.mp4", "--audio " + folder.path("none.wav")), 3, "no such file"},
      {"film room --width 32 -o " + folder.path("a.mp4"), 2, "nothing moves in it"},
      {"film none.glb --width 32 -o " + folder.path("a.mp4"), 3, "none.glb"},
  };
  for (const auto& [command, code, why] : kCases) {
    EXPECT_EQ(run(command), code) << command << err;
    EXPECT_NE(err.find(why), std::string::npos) << err;
    EXPECT_EQ(files(), 0u) << command;
  }
}

}  // namespace
