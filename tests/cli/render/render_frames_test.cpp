// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Videos frame by frame, as a farm runs them.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/support/cli_runner.h"
#include "tests/support/moving_files.h"

namespace ods::cli_frames_test {

class RenderFrames : public Cli {
 protected:
  // A coloured triangle that bends for two seconds, behind the camera.
  void SetUp() override {
    ods::GltfBuilder file = ods::make_skinned(false);
    file.node(0).erase("translation");
    file.node(1)["translation"] = {-1.0, 0.0, 2.0};
    file.primitive()["material"] = 0;
    file.json["materials"] =
        ods::GltfJson::parse(R"([{"pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.5, 0.8, 1]}}])");
    const ods::Binary bytes = file.glb();
    std::ofstream(scene, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
  }

  // ods render of it, tiny.
  std::string video(const std::string& words, const std::string& name = "shot.####.png") const {
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

TEST_F(RenderFrames, AFrameAloneIsTheFrameOfTheRun) {
  for (const std::string noise : {"fixed", "changing"}) {
    const std::string words = "--turntable 1,0,0,0 --shutter 180 --grain " + noise;  // turns the viewer on the spot
    ASSERT_EQ(run(video("--frames 5-9x2 " + words)), 0) << err;
    ASSERT_EQ(run(video("--frames 7 " + words, "alone.%04d.png")), 0) << err;
    EXPECT_EQ(out, folder.path("alone.0007.png") + "\n");
    EXPECT_GT(bytes("alone.0007.png").size(), 100u);
    EXPECT_TRUE(bytes("shot.0007.png") == bytes("alone.0007.png"));
    EXPECT_FALSE(bytes("shot.0007.png") == bytes("shot.0005.png"));
    EXPECT_EQ(files(), 4u);
  }
}

TEST_F(RenderFrames, NoiseIsFixedOrChanges) {
  const std::string still = "render lamp --width 32 --samples 1 --frames 1-2 -o ";
  ASSERT_EQ(run(still + folder.path("fixed.#.png")), 0) << err;
  EXPECT_TRUE(bytes("fixed.1.png") == bytes("fixed.2.png"));
  ASSERT_EQ(run(still + folder.path("changing.#.png") + " --grain changing"), 0) << err;
  EXPECT_FALSE(bytes("changing.1.png") == bytes("changing.2.png"));
}

// A camera that flies from 0,1,4 to 0,3,4 in two seconds.
TEST_F(RenderFrames, AFilesCameraThatMovesIsNamedWhereItBeginsAndChangesTheNoise) {
  ods::GltfBuilder file = ods::make_skinned(false);
  file.json["cameras"] = ods::GltfJson::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
  file.json["nodes"].push_back(ods::GltfJson::parse(R"({"camera": 0, "translation": [5, 5, 5]})"));
  file.json["scenes"][0]["nodes"] = {0, 1, 3};
  ods::animate(file, ods::node_target(3, "translation"), {0, 2}, {0, 1, 4, 0, 3, 4}, "VEC3");
  const ods::Binary bytes_of_file = file.glb();
  own.write("fly.glb", {bytes_of_file.begin(), bytes_of_file.end()});
  const auto flight = [&](const std::string& name, const std::string& more) {
    return run("render " + own.path("fly.glb") + " --unit m --width 32 --samples 1 --fps 10 --frames 10-19 -o " +
               folder.path(name) + " " + more);
  };
  for (const std::string more : {"", "--shutter 180", "--exposure 0"}) {
    ASSERT_EQ(flight("a.##.png", more), 0) << err;
    EXPECT_NE(err.find("camera at 0,2,4, yaw 0 ("), std::string::npos) << more << err;
  }
  ASSERT_EQ(flight("fly.##.png", "--fly-to 0,2,9"), 0) << err;
  EXPECT_EQ(err.find("camera at 0,2,4,"), std::string::npos) << "one second along the way: " << err;
  ASSERT_EQ(flight("changing.##.png", "--grain changing --exposure 0"), 0) << err;
  ASSERT_EQ(flight("fixed.##.png", "--grain fixed --exposure 0"), 0) << err;
  EXPECT_TRUE(bytes("a.15.png") == bytes("changing.15.png"));
  EXPECT_FALSE(bytes("a.15.png") == bytes("fixed.15.png"));
  const std::string placed = "--position 0,2,4 --yaw 0 --exposure 0 ";
  ASSERT_EQ(flight("placed.##.png", placed), 0) << err;
  ASSERT_EQ(flight("placed_fixed.##.png", placed + "--grain fixed"), 0) << err;
  EXPECT_TRUE(bytes("placed.15.png") == bytes("placed_fixed.15.png"));
}

TEST_F(RenderFrames, WhatIsThereIsSkipped) {
  ASSERT_EQ(run(video("--frames 1-3")), 0) << err;
  const std::string second = bytes("shot.0002.png");
  std::ofstream(folder.path("shot.0002.png"), std::ios::trunc) << "mine";
  std::filesystem::remove(folder.path("shot.0003.png"));
  std::ofstream(folder.path("shot.0004.png"), std::ios::trunc).close();  // some farms reserve names so
  ASSERT_EQ(run(video("--frames 1-4 --skip-existing")), 0) << err;
  EXPECT_EQ(out, folder.path("shot.0003.png") + "\n" + folder.path("shot.0004.png") + "\n");
  EXPECT_NE(err.find("2 of 4 frames exist already"), std::string::npos) << err;
  EXPECT_EQ(bytes("shot.0002.png"), "mine");
  ASSERT_EQ(run(video("--frames 2")), 0) << err;
  EXPECT_TRUE(bytes("shot.0002.png") == second) << "without --skip-existing it is made again";
  ASSERT_EQ(run(video("--frames 1-4 --skip-existing")), 0) << err;
  EXPECT_EQ(out, "") << "nothing is left to do";
}

TEST_F(RenderFrames, EyesInTheirOwnFilesCountTogether) {
  const std::string name = "shot_%V.##.png";
  ASSERT_EQ(run(video("--frames 1-2", name)), 0) << err;
  for (const char* file : {"shot_left.01.png", "shot_left.02.png", "shot_right.01.png", "shot_right.02.png"}) {
    EXPECT_GT(bytes(file).size(), 0u) << file;
  }
  std::filesystem::remove(folder.path("shot_right.02.png"));
  ASSERT_EQ(run(video("--frames 1-2 --skip-existing", name)), 0) << err;
  EXPECT_EQ(files(), 4u);
}

TEST_F(RenderFrames, KilledAndResumedItIsTheSame) {
  ASSERT_EQ(run(video("--frames 0-5 --samples 256", "whole.#.png")), 0) << err;
  for (const char* line : {"camera at", "\"progress\":0.2", "\"progress\":0.5"}) {
    Ods command({"render", scene, "--position", "0,0,0", "--width", "32", "--samples", "256", "--fps", "10", "--frames",
                 "0-5", "-o", folder.path("cut.#.png"), "--skip-existing", "--progress", "json"});
    command.wait_for(line);
    command.kill(SIGKILL);
    EXPECT_EQ(command.finish(), 1000 + SIGKILL) << command.err;
  }
  ASSERT_EQ(run(video("--frames 0-5 --samples 256 --skip-existing", "cut.#.png")), 0) << err;
  EXPECT_NE(err.find(" of 6 frames exist already"), std::string::npos) << err;
  for (const char* frame : {"0", "1", "2", "3", "4", "5"}) {
    EXPECT_TRUE(bytes(std::string("cut.") + frame + ".png") == bytes(std::string("whole.") + frame + ".png")) << frame;
  }
  EXPECT_EQ(files(), 12u) << "no claims, no halves";
}

// --- several processes ----------------------------------------------------------------------------------------------

const std::vector<std::string> kFrames = {"1", "2", "3", "4", "5", "6"};

class SharedFrames : public RenderFrames {
 protected:
  std::vector<std::string> job(const std::string& samples) const {
    return {"render",     scene,       "--position",      "0,0,0",    "--width",
            "64",         "--samples", samples,           "--frames", "1-6",
            "--exposure", "0",         "--skip-existing", "-o",       folder.path("shot.#.png")};
  }
};

TEST_F(SharedFrames, EachIsRenderedOnce) {
  Ods first(job("256")), second(job("256"));
  EXPECT_EQ(first.finish(), 0) << first.err;
  EXPECT_EQ(second.finish(), 0) << second.err;
  for (const std::string& frame : kFrames) {
    const std::string name = "shot." + frame + ".png\n";
    const bool by_first = first.out.find(name) != std::string::npos,
               by_second = second.out.find(name) != std::string::npos;
    EXPECT_NE(by_first, by_second) << frame;
  }
  EXPECT_EQ(files(), kFrames.size()) << "no claims are left";
}

TEST_F(SharedFrames, TheFrameOfAProcessThatDiedIsTakenOver) {
  Ods first(job("1024"));
  while (!std::filesystem::exists(folder.path(".shot.1.png.claim"))) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));  // the test's own time limit ends this
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(50));  // the claim is written; the frame takes longer
  first.kill(SIGSTOP);
  Ods second(job("1"));
  second.wait_for("which is being made by process " + std::to_string(first.process()) + " on '");
  EXPECT_NE(second.err.find("waiting for frame "), std::string::npos) << second.err;
  first.kill(SIGKILL);
  first.finish();
  EXPECT_EQ(second.finish(), 0) << second.err;
  for (const std::string& frame : kFrames) EXPECT_GT(bytes("shot." + frame + ".png").size(), 100u) << frame;
  EXPECT_EQ(files(), kFrames.size()) << "no claims, no halves";
}

TEST_F(SharedFrames, OfAnotherMachineAreWaitedFor) {
  folder.write(".shot.2.png.claim", "omnistereo claim\nhost render7\nboot none-of-ours\nprocess 812\nsince now\n");
  Ods sharing(job("1"));
  sharing.wait_for("waiting for frame 2, which is being made by process 812 on 'render7', since now");
  std::filesystem::copy(folder.path("shot.1.png"), folder.path("shot.2.png"));
  EXPECT_EQ(sharing.finish(), 0) << sharing.err;
  EXPECT_EQ(sharing.out.find("shot.2.png"), std::string::npos) << sharing.out;
  // Without --skip-existing every frame is rendered, even if another process is rendering it.
  EXPECT_EQ(run(video("--frames 2", "shot.#.png")), 0) << err;
  // A claim without an update for more than a minute is free.
  std::filesystem::remove(folder.path("shot.2.png"));
  std::filesystem::last_write_time(folder.path(".shot.2.png.claim"),
                                   std::filesystem::file_time_type::clock::now() - std::chrono::seconds(70));
  EXPECT_EQ(run(video("--frames 1-3 --skip-existing", "shot.#.png")), 0) << err;
  EXPECT_EQ(out, folder.path("shot.2.png") + "\n");
}

TEST_F(RenderFrames, ATimeIsAPicture) {
  ASSERT_EQ(run(video("--time 0.5", "time.png")), 0) << err;
  ASSERT_EQ(run(video("--frames 5", "frame.#.png")), 0) << err;
  EXPECT_TRUE(bytes("time.png") == bytes("frame.5.png"));
  ASSERT_EQ(run(video("", "rest#.png")), 0) << err;
  EXPECT_NE(err.find("--time SECONDS"), std::string::npos) << err;
  EXPECT_GT(bytes("rest#.png").size(), 0u) << "no video is asked for: the name is as it stands";
}

TEST_F(RenderFrames, TheDurationMakesTheFrames) {
  ASSERT_EQ(run("render furnace --width 16 --samples 1 --turntable -0.5 --duration 0.5 --fps 8 -o " +
                folder.path("turn.#.png")),
            0)
      << err;
  EXPECT_EQ(files(), 4u);
  ASSERT_EQ(run(video("--frames all --duration 0.2")), 0) << err;
  EXPECT_EQ(files(), 6u);
  ASSERT_EQ(run("render " + scene + " --position 0,0,0 --width 8 --samples 1 --frames all --fps 2 -o " +
                folder.path("all.%d.png")),
            0)
      << err;
  EXPECT_EQ(files(), 10u) << "two seconds of two frames";
}

TEST_F(RenderFrames, MistakesAreExplained) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"--frames 1-2", "a place for their number"},
      {"--time 1 --frames 2", "give one"},
      {"--time 1 --animation walk", "none called 'walk'"},
      {"--turntable 1,2", "TURNS,X,Y,Z"},
      {"--fly-to 1,2", "--fly-to is X,Y,Z"},
      {"--grain coarse", "--grain is one of"},
  };
  for (const auto& [words, what] : mistakes) {
    EXPECT_EQ(run(video(words, "plain.png")), 2) << words;
    EXPECT_NE(err.find(what), std::string::npos) << err;
    EXPECT_EQ(files(), 0u);
  }
  EXPECT_EQ(run(video("--frames 1-b")), 2);
  expect_one_error();
}

}  // namespace ods::cli_frames_test
