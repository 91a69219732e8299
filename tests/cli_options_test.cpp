// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What the command answers to options that are wrong, and to those that every command has.
#include <gtest/gtest.h>

#include "tests/cli_runner.h"

namespace {

TEST_F(Cli, BadOptionsAreUsageErrors) {
  for (const char* words :
       {"--width 0",     "--width 17",    "--width -2",        "--width 1e9",    "--width 99999999999999999999",
        "--width x",     "--width 8.5",   "--samples 0",       "--samples -5",   "--bounces -1",
        "--seed -1",     "--threads -1",  "--env nan",         "--env 1,2",      "--env -1",
        "--env 1,1,1,1", "--eyes three",  "--layout diagonal", "--layout mono",  "--size huge",
        "--tone loud",   "--filter tent", "--quality best",    "--exposure inf", "--progress loudly",
        "--env=",        "--scene -1",    "--scene 0.5",       "--unknown",      "surplus",
        "--width"}) {
    EXPECT_EQ(run(render(words)), 2) << words;
    expect_one_error();
  }
  EXPECT_EQ(run("render"), 2);
  EXPECT_EQ(run("render furnace"), 2);
  expect_one_error();
}

struct Quiet {
  std::string words;
  bool has_result = false;  // text, which is what the command is for
};

// Every command takes -q: it writes nothing to stderr, and nothing to stdout but a result that is text.
TEST_F(Cli, QuietIsQuietInEveryCommand) {
  const auto at = [&](const std::string& name) { return folder.path(name); };
  const std::string tiny = " --width 32 --samples 1 ", png = at("p_TB.png"), film = at("f_360_TB.mp4");
  const std::vector<Quiet> commands = {
      {"render furnace" + tiny + "-o " + png},
      {"render furnace --sidecar" + tiny + "-o " + at("eye_%V.png")},
      {"render furnace" + tiny + "--frames 0-1 -o " + at("f.####.png")},
      {"render furnace" + tiny + "--transparent --eyes mono -o " + at("front.exr")},
      {"render furnace" + tiny + "--eyes mono -o " + at("back.exr")},
      {"render axis --width 512 --samples 1 --filter box -o " + at("axis_TB.png")},
      {"convert " + png + " -o " + at("c.png")},
      {"encode " + at("f.####.png") + " -o " + film},
      {"film furnace --duration 0.1" + tiny + "-o " + at("film.mp4")},
      {"title X --width 64 --height 3 -o " + at("title.exr")},
      {"over " + at("front.exr") + " " + at("back.exr") + " -o " + at("over.png")},
      {"rig --nearest 1 --width 64 -o " + at("rig.json") + " --for blender"},
      {"rig --nearest 1 --width 64", true},
      {"render furnace --samples 1 --rig " + at("rig.json") + " -o " + at("v.####.exr")},
      {"stitch " + at("rig.json") + " " + at("v.####.exr") + " -o " + at("s.png")},
      {"stitch " + at("rig.json") + " " + at("w.####.exr") + " --list-missing", true},
      {"inject " + film},
      {"inject " + at("back.exr")},
      {"testcard --width 64 -o " + at("card.png")},
      {"testcard --width 64 --duration 0.1 -o " + at("card.mp4")},
      {"camera --for unity --neck 0.1 -o " + at("camera.txt")},
      {"camera --for unity --neck 0.1", true},
      {"project 0,0,-1", true},
      {"compare " + png + " " + at("c.png"), true},
      {"lint " + at("axis_TB.png"), true},
      {"probe " + film, true},
      {"info furnace", true},
      {"scenes", true},
      {"sizes", true},
  };
  for (const Quiet& command : commands) {
    EXPECT_EQ(run(command.words + " -q"), 0) << command.words << "\n" << err;
    EXPECT_EQ(err, "") << command.words;
    EXPECT_EQ(!out.empty(), command.has_result) << command.words << "\n" << out;
  }
}

TEST_F(Cli, BadCamerasAreUsageErrors) {
  for (const char* words : {"--ipd nan",
                            "--ipd -0.1",
                            "--ipd inf",
                            "--position 1,2",
                            "--position a,b,c",
                            "--position nan,0,0",
                            "--yaw nan",
                            "--yaw ninety",
                            "--merge cubic",
                            "--projection mercator",
                            "--range 0,400",
                            "--face inside",
                            "--convergence toe-in,0",
                            "--axis 0,0,0",
                            "--lens 1",
                            "--like cycles:cheese=1",
                            "--like cheese",
                            "--merge map",
                            "--projection cube-3x2 --width 100",
                            "--fov 200 --projection perspective",
                            "--merge cosine,80,60",
                            "--merge cosine,10,95",
                            "--merge cosine,",
                            "--merge ,",
                            "--merge cosine,60,90,0",
                            "--merge cosine,60,90,1,1",
                            "--merge-top nan",
                            "--camera nowhere",
                            "--camera="}) {
    EXPECT_EQ(run(render(words)), 2) << words;
    expect_one_error();
  }
}

TEST_F(Cli, ANameThatMisleadsIsSaidOnce) {
  for (const auto& [name, more] :
       {std::pair<std::string, std::string>{"a_180_LR.png", ""}, {"a_180_LR.####.png", " --frames 1 --turntable 1"}}) {
    ASSERT_EQ(run("render furnace --width 16 --samples 1 -o " + folder.path(name) + more), 0) << err;
    const size_t at = err.find("its name ends in _LR, but it is top-bottom: readers will go by the name");
    EXPECT_NE(at, std::string::npos) << err;
    EXPECT_EQ(err.find("readers will go by the name", at + 60), std::string::npos) << err;
  }
}

}  // namespace
