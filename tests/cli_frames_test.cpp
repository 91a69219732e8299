// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Films frame by frame, as a farm runs them.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "tests/cli_runner.h"
#include "tests/moving_files.h"

namespace {

class CliFrames : public Cli {
 protected:
  // A coloured triangle that bends for two seconds, behind the camera.
  void SetUp() override {
    ods::GltfBuilder file = ods::make_skinned(false);
    file.node(0).erase("translation");
    file.node(1)["translation"] = {-1.0, 0.0, 2.0};
    file.primitive()["material"] = 0;
    file.json["materials"] = ods::Json::parse(R"([{"pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.5, 0.8, 1]}}])");
    const ods::Binary bytes = file.glb();
    std::ofstream(scene, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
  }

  // ods render of it, tiny.
  std::string film(const std::string& words, const std::string& name = "shot.####.png") const {
    return "render " + scene + " --position 0,0,0 --width 32 --samples 1 --fps 10 -o " + folder.path(name) + " " +
           words;
  }

  std::string bytes(const std::string& name) const {
    std::ifstream file(folder.path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  ods::TemporaryFolder own;
  const std::string scene = own.path("scene.glb");
};

TEST_F(CliFrames, AFrameAloneIsTheFrameOfTheRun) {
  for (const std::string noise : {"fixed", "changing"}) {
    const std::string words = "--turntable 1 --shutter 180 --noise " + noise;
    ASSERT_EQ(run(film("--frames 5-9x2 " + words)), 0) << err;
    ASSERT_EQ(run(film("--frames 7 " + words, "alone.%04d.png")), 0) << err;
    EXPECT_EQ(out, folder.path("alone.0007.png") + "\n");
    EXPECT_GT(bytes("alone.0007.png").size(), 100u);
    EXPECT_TRUE(bytes("shot.0007.png") == bytes("alone.0007.png"));
    EXPECT_FALSE(bytes("shot.0007.png") == bytes("shot.0005.png"));
    EXPECT_EQ(files(), 4u);
  }
}

TEST_F(CliFrames, NoiseIsFixedOrChanges) {
  const std::string still = "render lamp --width 32 --samples 1 --frames 1-2 -o ";
  ASSERT_EQ(run(still + folder.path("fixed.#.png")), 0) << err;
  EXPECT_TRUE(bytes("fixed.1.png") == bytes("fixed.2.png"));
  ASSERT_EQ(run(still + folder.path("changing.#.png") + " --noise changing"), 0) << err;
  EXPECT_FALSE(bytes("changing.1.png") == bytes("changing.2.png"));
}

TEST_F(CliFrames, WhatIsThereIsSkipped) {
  ASSERT_EQ(run(film("--frames 1-3")), 0) << err;
  const std::string second = bytes("shot.0002.png");
  std::ofstream(folder.path("shot.0002.png"), std::ios::trunc) << "mine";
  std::filesystem::remove(folder.path("shot.0003.png"));
  std::ofstream(folder.path("shot.0004.png"), std::ios::trunc).close();  // some farms reserve names so
  ASSERT_EQ(run(film("--frames 1-4 --skip-existing")), 0) << err;
  EXPECT_EQ(out, folder.path("shot.0003.png") + "\n" + folder.path("shot.0004.png") + "\n");
  EXPECT_NE(err.find("2 of 4 frames are there already"), std::string::npos) << err;
  EXPECT_EQ(bytes("shot.0002.png"), "mine");
  ASSERT_EQ(run(film("--frames 2")), 0) << err;
  EXPECT_TRUE(bytes("shot.0002.png") == second) << "without --skip-existing it is made again";
  ASSERT_EQ(run(film("--frames 1-4 --skip-existing")), 0) << err;
  EXPECT_EQ(out, "") << "nothing is left to do";
}

TEST_F(CliFrames, EyesInTheirOwnFilesCountTogether) {
  const std::string name = "shot_%V.##.png";
  ASSERT_EQ(run(film("--frames 1-2", name)), 0) << err;
  for (const char* file : {"shot_left.01.png", "shot_left.02.png", "shot_right.01.png", "shot_right.02.png"}) {
    EXPECT_GT(bytes(file).size(), 0u) << file;
  }
  std::filesystem::remove(folder.path("shot_right.02.png"));
  ASSERT_EQ(run(film("--frames 1-2 --skip-existing", name)), 0) << err;
  EXPECT_EQ(files(), 4u);
}

TEST_F(CliFrames, KilledAndResumedItIsTheSame) {
  ASSERT_EQ(run(film("--frames 0-5", "whole.#.png")), 0) << err;
  std::mt19937 random(5);
  for (int round = 0; round < 4; round++) {
    Ods command({"render", scene, "--position", "0,0,0", "--width", "32", "--samples", "1", "--fps", "10", "--frames",
                 "0-5", "-o", folder.path("cut.#.png"), "--skip-existing"});
    std::this_thread::sleep_for(std::chrono::milliseconds(250 + random() % 150));
    command.kill(SIGKILL);
    command.finish();
  }
  ASSERT_EQ(run(film("--frames 0-5 --skip-existing", "cut.#.png")), 0) << err;
  for (const char* frame : {"0", "1", "2", "3", "4", "5"}) {
    EXPECT_TRUE(bytes(std::string("cut.") + frame + ".png") == bytes(std::string("whole.") + frame + ".png")) << frame;
  }
}

TEST_F(CliFrames, ATimeIsAPicture) {
  ASSERT_EQ(run(film("--time 0.5", "time.png")), 0) << err;
  ASSERT_EQ(run(film("--frames 5", "frame.#.png")), 0) << err;
  EXPECT_TRUE(bytes("time.png") == bytes("frame.5.png"));
  ASSERT_EQ(run(film("", "rest#.png")), 0) << err;
  EXPECT_NE(err.find("--time SECONDS"), std::string::npos) << err;
  EXPECT_GT(bytes("rest#.png").size(), 0u) << "no film is asked for: the name is as it stands";
}

TEST_F(CliFrames, TheDurationMakesTheFrames) {
  ASSERT_EQ(run("render furnace --width 16 --samples 1 --turntable -0.5 --duration 0.5 --fps 8 -o " +
                folder.path("turn.#.png")),
            0)
      << err;
  EXPECT_EQ(files(), 4u);
  ASSERT_EQ(run(film("--frames all --duration 0.2")), 0) << err;
  EXPECT_EQ(files(), 6u);
  ASSERT_EQ(run("render " + scene + " --position 0,0,0 --width 8 --samples 1 --frames all --fps 2 -o " +
                folder.path("all.%d.png")),
            0)
      << err;
  EXPECT_EQ(files(), 10u) << "two seconds of two frames";
}

TEST_F(CliFrames, MistakesAreExplained) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"--frames 1-2", "a place for the number"},
      {"--time 1 --frames 2", "give one"},
      {"--time 1 --animation walk", "none called 'walk'"},
      {"--turntable 1,2", "TURNS,X,Y,Z"},
      {"--fly-to 1,2", "--fly-to is X,Y,Z"},
      {"--noise grainy", "--noise is one of"},
  };
  for (const auto& [words, what] : mistakes) {
    EXPECT_EQ(run(film(words, "plain.png")), 2) << words;
    EXPECT_NE(err.find(what), std::string::npos) << err;
    EXPECT_EQ(files(), 0u);
  }
  EXPECT_EQ(run(film("--frames 1-b")), 2);
  expect_one_error();
}

}  // namespace
