// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Films whose first frames are rendered before the scene is converted, with a script in the place of Blender.
#include "cli/bridge/film_conversion.h"

#include "tests/support/bridge_fixture.h"

namespace ods::bridge_test {

class FilmBridge : public Bridge {
 protected:
  // A script that converts the beginning at once, and for the whole does this first.
  void whole(const std::string& text, const std::string& said = "echo 'ods-bridge slow 100' >&2") {
    answer(R"({"omnistereo_bridge": 1, "environment": "0.5,0.5,0.5", "frames": {"first": 1, "count": 8, "saved": 1},
        "warnings": ["hair of 'x' is lost"],
        "camera": {"omnistereo_camera": 1, "position": [0, 0, 2], "projection": {"name": "lat-long"}}})",
           "case \"$*\" in *--beginning*) echo \"$*\" >>" + folder_ + "/beginning ;; *) " + said + "; " + text +
               " ;; esac");
  }

  std::string video(const char* name) const { return folder_ + "/" + name; }

  std::vector<std::string> words(const std::string& output, std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {
        "video", scene_,      "--blender", folder_ + "/blender", "-o",       output, "--frames", "1-8", "--width",
        "32",    "--samples", "4",         "--keep-frames",      "--device", "cpu"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  // Waits until the film's third frame exists.
  static std::string until_frame(const std::string& output) {
    return "while [ ! -f " + output + ".frames/frame.000003.exr ]; do sleep 0.02; done";
  }

  size_t beginnings() const {
    const std::string all = read(folder_ + "/beginning");
    return static_cast<size_t>(std::count(all.begin(), all.end(), '\n'));
  }

  static size_t count(const std::string& text, const std::string& words) {
    size_t found = 0;
    for (size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) found++;
    return found;
  }
};

// The script for the whole waits for the frame, so a command that renders only what is whole never ends.
TEST_F(FilmBridge, TheFirstFramesComeBeforeTheWhole) {
  const std::string early = video("early.mp4"), late = video("late.mp4");
  whole(until_frame(early));
  Ods first(words(early, {"--blender-limit", "60"}));
  ASSERT_EQ(first.finish(), 0) << first.err;
  EXPECT_EQ(beginnings(), 1u);
  EXPECT_NE(read(folder_ + "/beginning").find("--beginning 3 --first 1 --last 8"), std::string::npos);
  EXPECT_NE(first.err.find("3 of 8 frames exist already"), std::string::npos) << first.err;
  EXPECT_EQ(count(first.err, "hair of 'x' is lost"), 1u) << first.err;
  EXPECT_EQ(first.out, early + "\n");
  Ods second(words(late));
  ASSERT_EQ(second.finish(), 0) << second.err;
  EXPECT_EQ(runs(), 2u) << "the whole is kept";
  for (int frame = 1; frame <= 8; frame++) {
    const std::string name = ".frames/frame.00000" + std::to_string(frame) + ".exr";
    EXPECT_EQ(read(early + name), read(late + name)) << frame;
  }
  EXPECT_EQ(read(early), read(late));
}

TEST_F(FilmBridge, AQuickConversionIsOne) {
  whole("true", "true");
  Ods ods(words(video("a.mp4")));
  ASSERT_EQ(ods.finish(), 0) << ods.err;
  EXPECT_EQ(runs(), 1u);
}

TEST_F(FilmBridge, ABeginningThatFailsIsNoLoss) {
  whole("true");
  write(folder_ + "/made.json", "broken");
  whole("sleep 1");
  program("case \"$*\" in *--beginning*) kill -SEGV $$ ;; *) echo 'ods-bridge slow 9' >&2; sleep 1; esac\ncp " +
          folder_ + "/made.glb \"$folder/scene.glb\"\ncp " + folder_ + "/made.json \"$folder/bridge.json\"\n" +
          "echo 'ods-bridge done 1' >&2\n");
  Ods ods(words(video("a.mp4")));
  EXPECT_EQ(ods.finish(), 0) << ods.err;
  EXPECT_EQ(count(ods.err, "crashed"), 0u) << ods.err;
}

// The frames that exist stay, and the next command continues with them.
TEST_F(FilmBridge, AWholeThatFailsMidwayIsOneLine) {
  const std::string output = video("a.mp4");
  whole(until_frame(output) + "; echo 'ods-bridge error it broke at frame 7' >&2; exit 3");
  Ods ods(words(output));
  EXPECT_EQ(ods.finish(), 3);
  EXPECT_NE(ods.err.find("ods: error: '" + scene_ + "': it broke at frame 7"), std::string::npos) << ods.err;
  EXPECT_EQ(count(ods.err, "error"), 1u) << ods.err;
  EXPECT_TRUE(fs::exists(output + ".frames/frame.000003.exr"));
  EXPECT_FALSE(fs::exists(output));
  EXPECT_EQ(kept(), 0u);
  whole("true", "true");
  Ods again(words(output));
  EXPECT_EQ(again.finish(), 0) << again.err;
  EXPECT_NE(again.err.find("3 of 8 frames exist already"), std::string::npos) << again.err;
}

TEST_F(FilmBridge, WhateverEndsUsEndsBothBlenders) {
  for (const int signal : {SIGINT, SIGTERM}) {
    fs::remove(folder_ + "/started");
    const std::string output = video(signal == SIGINT ? "a.mp4" : "b.mp4");
    whole(until_frame(output) + "\n" + hanging());
    Ods ods(words(output));
    while (!fs::exists(folder_ + "/started")) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ods.kill(signal);
    EXPECT_EQ(ods.finish(), 128 + signal) << ods.err;
    expect_ended();
    for (int i = 0; i < 200 && has_folder(); i++) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(kept(), 0u) << signal;
  }
}

// Frames that other processes share, times that are not the file's, and a merge that suits all frames need the whole
// scene.
TEST_F(FilmBridge, SomeFilmsNeedTheWhole) {
  whole("sleep 0.2");
  int number = 0;
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--only", "1-4"}, {"--fps", "12"}, {"--merge", "auto"}}) {
    Ods ods(words(video(("v" + std::to_string(number++) + ".mp4").c_str()), more));
    EXPECT_EQ(ods.finish(), 0) << ods.err;
    fs::remove_all(folder_ + "/cache");
  }
  EXPECT_EQ(beginnings(), 0u);
}

}  // namespace ods::bridge_test
