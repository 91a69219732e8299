// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The command as its user meets it: what it writes, where, and how it ends.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "cli/console/command.h"
#include "tests/support/cli_runner.h"
#include "tests/support/gltf_builder.h"

namespace ods::cli_test {

TEST_F(Cli, HelpStartsWithExamples) {
  std::vector<std::string> requests = {"--help", "-h", "help"};
  for (const Command& command : commands()) requests.push_back(std::string(command.name) + " --help");
  for (const std::string& words : requests) {
    EXPECT_EQ(run(words), 0) << words;
    EXPECT_EQ(err, "") << words;
    EXPECT_TRUE(out.find("Commands:") != std::string::npos || out.find("-q,--quiet") != std::string::npos) << words;
    std::istringstream lines(out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 118u) << line;
    EXPECT_NE(out.find("Examples:\n  ods "), std::string::npos) << words;
    EXPECT_LT(out.find("Examples:"), std::min(out.find("Usage:"), out.find("Commands:"))) << words;
  }
}

// Whatever else is on the line, faults included, and before any file is opened.
TEST_F(Cli, HelpWinsWhereverItStands) {
  for (const char* words :
       {"convert absent.png --help", "convert absent.png -h", "convert -h absent.png", "convert absent.png -qh",
        "camera --camera-file absent.json --help", "camera --help --camera-file absent.json",
        "convert --camera-file absent.json -h", "render furnace --width 0 --help", "render --progress loudly --help",
        "render --unknown -h", "render -h --width", "render furnace -o --help", "project x y --help"}) {
    EXPECT_EQ(run(words), 0) << words << "\n" << err;
    EXPECT_EQ(err, "") << words;
    EXPECT_NE(out.find("Usage: ods "), std::string::npos) << words << "\n" << out;
  }
  EXPECT_EQ(run("convert absent.png --help=man"), 0) << err;
  EXPECT_TRUE(out.starts_with(".TH ")) << out;
}

TEST_F(Cli, HelpIsAValueBehindTwoDashesOrAnEqualsSign) {
  EXPECT_EQ(run("title -q --width 64 --text-height 3 -o " + folder.path("a.png") + " -- --help"), 0) << err;
  EXPECT_EQ(out, "");
  EXPECT_EQ(files(), 1u);
  EXPECT_EQ(run("render furnace --output=--help"), 2);
  EXPECT_NE(err.find("'--help'"), std::string::npos) << err;
}

TEST_F(Cli, HelpPrintsDefaults) {
  run("render --help");
  for (const char* part : {"--width N", "[2048]", "[0.065]", "[blackman-harris]", "[top-bottom]", "draft"}) {
    EXPECT_NE(out.find(part), std::string::npos) << part;
  }
}

TEST_F(Cli, NothingToDoIsExplained) {
  EXPECT_EQ(run(""), 2);
  EXPECT_EQ(out, "");
  EXPECT_NE(err.find("Commands:\n  render"), std::string::npos);
}

TEST_F(Cli, VersionNamesTheLibraries) {
  EXPECT_EQ(run("--version"), 0);
  for (const char* part :
       {"ods 0", "Embree 3", "libtiff 4", "libwebp 1", "oneTBB 202", "nlohmann JSON 3", "fmt ", "CLI11 2"}) {
    if (std::string_view(part) == "Embree 3" && out.find("Embree 4") != std::string::npos) continue;
    EXPECT_NE(out.find(part), std::string::npos) << part << " in " << out;
  }
}

TEST_F(Cli, ScenesAreListed) {
  EXPECT_EQ(run("scenes"), 0);
  EXPECT_NE(out.find("room "), std::string::npos);
  EXPECT_EQ(err, "");
}

TEST_F(Cli, InfoIsForPeopleAndForPrograms) {
  EXPECT_EQ(run("info furnace"), 0) << err;
  EXPECT_NE(out.find("triangles "), std::string::npos) << out;
  EXPECT_EQ(err, "");
  EXPECT_EQ(run("info furnace --json --position 0,0,0.25"), 0) << err;
  EXPECT_TRUE(out.starts_with("{\n") && out.ends_with("}\n")) << out;
  EXPECT_NE(out.find("\"nearest_surface\": "), std::string::npos) << out;
  EXPECT_EQ(err, "");
}

TEST_F(Cli, SizesAreListed) {
  EXPECT_EQ(run("sizes"), 0) << err;
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 110u) << line;
  EXPECT_EQ(run("sizes tb-high-6480 --json"), 0) << err;
  EXPECT_NE(out.find("\"layout\": \"top-bottom\""), std::string::npos) << out;
  EXPECT_EQ(run("sizes tb-hi-6480"), 2);
  EXPECT_NE(err.find("did you mean 'tb-high-6480'?"), std::string::npos) << err;
}

TEST_F(Cli, DevicesAreListed) {
  EXPECT_EQ(run("devices"), 0) << err;
  EXPECT_TRUE(out.starts_with("cpu ")) << out;
  EXPECT_NE(out.find("auto takes "), std::string::npos) << out;
  EXPECT_EQ(err, "");
}

TEST_F(Cli, ANamedSizeSetsWidthAndLayout) {
  const std::string small = " --quality draft --samples 1 --eyes mono";
  EXPECT_EQ(run("render furnace -q --size tb-quick-test-512" + small + " -o " + folder.path("a.exr")), 0) << err;
  EXPECT_EQ(run("render furnace -q --width 512" + small + " -o " + folder.path("b.exr")), 0) << err;
  EXPECT_EQ(folder.read("a.exr"), folder.read("b.exr"));
  EXPECT_EQ(run("render furnace -q --width 16 --size lr-minimum-7200 --samples 1 -o " + folder.path("c.exr")), 0)
      << err;
  EXPECT_EQ(run("compare " + folder.path("c.exr") + " " + folder.path("c.exr")), 0) << err;
  EXPECT_NE(out.find("side-by-side, according to the file"), std::string::npos) << out;
}

TEST_F(Cli, CompareMeasuresAndJudges) {
  const std::string render = "render furnace -q --width 16 --samples 1 ";
  EXPECT_EQ(run(render + "-o " + folder.path("a_bt.png") + " --layout BT"), 0) << err;
  EXPECT_EQ(run(render + "-o " + folder.path("b_%V.png")), 0) << err;
  EXPECT_EQ(run(render + "--exposure -1 -o " + folder.path("c_SBS.png") + " --layout sbs"), 0) << err;
  const std::string a = "compare " + folder.path("a_bt.png") + " ";
  EXPECT_EQ(run(a + folder.path("b_%V.png") + " --max-error 0 --json"), 0) << err;
  EXPECT_NE(out.find("\"rmse\": 0.0"), std::string::npos) << out;
  for (const char* limit : {"--max-rmse 0.001", "--min-psnr 60", "--max-error 0.001"}) {
    EXPECT_EQ(run(a + folder.path("c_SBS.png") + " " + limit), 5) << limit;
    EXPECT_NE(out.find(limit), std::string::npos) << out;
    EXPECT_EQ(err, "") << "a verdict is not an error";
    EXPECT_EQ(run(a + folder.path("c_SBS.png") + " --json " + limit), 5) << limit;
    EXPECT_NE(out.find(limit), std::string::npos) << out;
  }
  EXPECT_EQ(run(a + folder.path("c_SBS.png") + " --diff " + folder.path("d.exr")), 0) << err;
  EXPECT_EQ(run(a + folder.path("d.exr") + " --min-psnr 100"), 5) << err;
  EXPECT_EQ(run(a + folder.path("b_left.png") + " --layout separate"), 3);
  EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
  EXPECT_EQ(run(a + folder.path("absent.png")), 3);
}

TEST_F(Cli, SlipsGetASuggestion) {
  EXPECT_EQ(run("rendr"), 2);
  expect_one_error();
  EXPECT_NE(err.find("did you mean 'render'?"), std::string::npos) << err;
  EXPECT_EQ(run(render("--sampels 2")), 2);
  expect_one_error();
  EXPECT_NE(err.find("did you mean '--samples'?"), std::string::npos) << err;
  EXPECT_EQ(run("zzzzzzzz"), 2);
  EXPECT_EQ(err.find("did you mean"), std::string::npos) << err;
}

TEST_F(Cli, AbsentAndBrokenInputsAreInputErrors) {
  for (const char* name : {"absent.glb", "absent.gltf", "absent"}) {
    EXPECT_EQ(run("render " + folder.path(name) + " -o " + folder.path("picture.png")), 3) << name;
    expect_one_error();
    EXPECT_EQ(run("info " + folder.path(name)), 3) << name;
    expect_one_error();
  }
  EXPECT_EQ(run(render("--env " + folder.path("absent.hdr"))), 3);
  expect_one_error();
  EXPECT_EQ(run("render " + folder.path("") + " -o " + folder.path("picture.png")), 3);
  expect_one_error();
}

TEST_F(Cli, OutputThatCannotBeIsFoundBeforeRendering) {
  // Would take hours if it were rendered first.
  const std::string hours = "render furnace --width 8192 --samples 100000 -o ";
  for (const std::string& output :
       {folder.path("picture.unknown"), folder.path("picture"), folder.path(""), std::string("/dev/full/picture.png"),
        std::string("/dev/full"), std::string("/proc/picture.png"), folder.path(std::string(300, 'x') + ".png")}) {
    EXPECT_EQ(run(hours + output), output.ends_with(".png") ? 4 : 2) << output;
    expect_one_error();
  }
}

TEST_F(Cli, AFullDiskLeavesNoFile) {
  for (const char* name : {"picture.png", "picture.exr", "picture.jpg", "picture.tif", "picture.hdr", "picture.webp"}) {
    EXPECT_EQ(run("render furnace -q --width 64 --samples 1 -o " + folder.path(name), 64), 4) << name;
    expect_one_error();
    EXPECT_TRUE(err.ends_with("': the disk is full or was lost\n") || err.ends_with("': File too large\n")) << err;
  }
}

TEST_F(Cli, StdoutHoldsTheFileAndNothingElse) {
  EXPECT_EQ(run(render("--progress plain")), 0) << err;
  EXPECT_EQ(out, folder.path("picture.png") + "\n");
  EXPECT_NE(err.find("ods: camera at "), std::string::npos) << err;
  EXPECT_EQ(files(), 1u);
}

TEST_F(Cli, EveryEyeItsFile) {
  EXPECT_EQ(run("render furnace --width 16 --samples 1 -o " + folder.path("eye_%V.png")), 0) << err;
  EXPECT_EQ(out, folder.path("eye_left.png") + "\n" + folder.path("eye_right.png") + "\n");
  EXPECT_EQ(files(), 2u);
}

TEST_F(Cli, TheSameSeedGivesTheSameFile) {
  auto picture = [&](const std::string& words) {
    EXPECT_EQ(run(render("-q " + words)), 0) << err;
    return folder.read("picture.png");
  };
  const std::string one = picture("--samples 3 --threads 1 --env 1 --seed 7");
  EXPECT_EQ(one, picture("--samples 3 --threads 2 --env 1 --seed 7"));
}

TEST_F(Cli, OptionsAreFreeInTheirOrderAndTheLastWins) {
  EXPECT_EQ(run("render --width 64 -q -o " + folder.path("picture.png") + " --samples 1 furnace --width 16"), 0) << err;
  EXPECT_EQ(files(), 1u);
}

TEST_F(Cli, FarmsReadTheirLinesOnStdout) {
  const std::vector<std::pair<std::string, std::string>> modes = {
      {"deadline", "Progress: 100%\n"}, {"openjd", "openjd_progress: 100\n"}, {"tractor", "ALF_PROGRESS 100%\n"}};
  for (const auto& [mode, line] : modes) {
    EXPECT_EQ(run(render("--progress " + mode)), 0);
    EXPECT_NE(out.find(line), std::string::npos) << out;
    EXPECT_EQ(err.find(line), std::string::npos) << err;
  }
  EXPECT_EQ(run("render absent.glb --progress openjd -o " + folder.path("a.png")), 3);
  EXPECT_TRUE(out.starts_with("openjd_fail: ")) << out;
}

TEST_F(Cli, AnInterruptedRenderLeavesNoFile) {
  for (const int number : {SIGINT, SIGTERM}) {
    Ods command({"render", "furnace", "--width", "2048", "--samples", "100000", "-o", folder.path("a.png")});
    command.wait_for("camera at");
    command.kill(number);
    EXPECT_EQ(command.finish(), 128 + number) << command.err;
    EXPECT_EQ(command.out, "");
    EXPECT_NE(command.err.find("ods: interrupted"), std::string::npos) << command.err;
    EXPECT_EQ(files(), 0u);
  }
}

// The loader logs into a pipe that is too small for the log, so the command is stopped in its libraries' constructors
// when the signal comes.
TEST_F(Cli, AnInterruptBeforeMainIsOneLikeAnyOther) {
  if (kSanitized) GTEST_SKIP() << "skipped: a sanitizer handles no signals yet";
  int pipe[2];
  ASSERT_EQ(pipe2(pipe, O_CLOEXEC), 0);
  ASSERT_EQ(fcntl(pipe[1], F_SETPIPE_SZ, 4096), 4096);
  const pid_t process = fork();
  if (process == 0) {
    dup2(pipe[1], STDERR_FILENO);
    setenv("LD_DEBUG", "files", 1);
    execl(ods_command().c_str(), "ods", "scenes", nullptr);
    _exit(127);
  }
  close(pipe[1]);
  std::string said;
  bool is_sent = false;
  for (char c = 0; read(pipe[0], &c, 1) == 1;) {
    said += c;
    if (is_sent || !said.ends_with("calling init: ") || said.find("calling preinit: ") == std::string::npos) continue;
    is_sent = ::kill(process, SIGINT) == 0;
  }
  close(pipe[0]);
  int result = 0;
  waitpid(process, &result, 0);
  EXPECT_TRUE(is_sent) << said;
  EXPECT_TRUE(WIFEXITED(result) && WEXITSTATUS(result) == 130) << result;
  EXPECT_NE(said.find("ods: interrupted\n"), std::string::npos) << said;
  EXPECT_EQ(said.find("transferring control: "), std::string::npos) << "before main: " << said;
}

// However often it is told to stop, and while it saves.
TEST_F(Cli, AnInterruptEndsSaving) {
  for (const int times : {1, 2}) {
    Ods command({"render", "furnace", "--width", "2048", "--samples", "1", "--bounces", "0", "--eyes", "mono",
                 "--progress", "json", "-o", folder.path("a.exr")});
    command.wait_for("\"progress\":1.00");
    for (int i = 0; i < 10000 && files() == 0; i++) usleep(1000);  // until its temporary file is there
    for (int i = 0; i < times; i++) command.kill(SIGINT);
    EXPECT_EQ(command.finish(), 130) << command.err;
    EXPECT_NE(command.err.find("{\"error\":\"interrupted\",\"exit_code\":130}\n"), std::string::npos) << command.err;
    EXPECT_EQ(files(), 0u);
  }
}

// Every line on stderr is a JSON object.
TEST_F(Cli, JsonIsAllThatAProgramReads) {
  ods::GltfBuilder scene = ods::make_triangle();
  scene.json["extensionsUsed"] = {"EXT_\"unknown\""};
  const ods::Binary glb = scene.glb();
  folder.write("a.glb", {glb.begin(), glb.end()});
  const std::vector<std::pair<std::string, int>> runs = {
      {render("--progress json --env 1"), 0},
      {"render " + folder.path("a.glb") + " --width 16 --samples 1 --progress json -o " + folder.path("b.png"), 0},
      {"render absent.glb --progress json -o " + folder.path("c.png"), 3}};
  std::set<std::string> keys;
  for (const auto& [words, code] : runs) {
    EXPECT_EQ(run(words), code) << err;
    std::istringstream lines(err);
    for (std::string line; std::getline(lines, line);) {
      const auto object = nlohmann::ordered_json::parse(line, nullptr, false);
      EXPECT_TRUE(object.is_object()) << line;
      if (object.is_object()) keys.insert(object.begin().key());
    }
  }
  EXPECT_EQ(keys, (std::set<std::string>{"error", "note", "progress", "warning"}));
  EXPECT_EQ(run("render furnace --progress json --width 0"), 2);
  EXPECT_EQ(nlohmann::json::parse(err, nullptr, false)["exit_code"], 2) << err;
  EXPECT_EQ(run("render furnace --width 0 --progress json -o " + folder.path("c.png")), 2);
  EXPECT_EQ(nlohmann::json::parse(err, nullptr, false)["exit_code"], 2) << err;
  EXPECT_EQ(run("inject absent.mp4 --progress json"), 3);
  EXPECT_EQ(nlohmann::json::parse(err, nullptr, false)["exit_code"], 3) << err;
}

// A scene's pictures are read on all processors, unless told otherwise.
TEST_F(Cli, ThreadsAreLimitedFromTheStart) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "skipped: one processor starts no threads anyway";
  EXPECT_EQ(run(render("-q")), 0) << err;
  const auto write_scene = [&](const std::string& file, int textures) {
    ods::GltfBuilder scene = ods::make_triangle();
    for (int i = 0; i < textures; i++) {
      const std::string name = std::to_string(i) + ".png";
      folder.write(name, folder.read("picture.png"));
      scene.json["images"].push_back({{"uri", name}});
      scene.json["textures"].push_back({{"source", i}});
      scene.json["materials"].push_back({{"emissiveTexture", {{"index", i}}}});
    }
    const ods::Binary glb = scene.glb();
    folder.write(file, {glb.begin(), glb.end()});
  };
  write_scene("one.glb", 1);
  write_scene("many.glb", 32);
  const auto threads_with = [&](const std::string& name, const std::string& limit) {
    Ods command({"render", name, "--samples", "100000", "--threads", limit, "-o", folder.path("a.png")});
    command.wait_for("camera at");
    size_t threads = command.threads();
    for (int same = 0; same < 10;) {  // those that begin or end may still be on their way
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      same = command.threads() == threads ? same + 1 : 0;
      threads = command.threads();
    }
    command.kill(SIGTERM);
    EXPECT_EQ(command.finish(), 128 + SIGTERM);
    return threads;
  };
  const size_t idle = threads_with(folder.path("one.glb"), "1");  // what the libraries start for nothing
  EXPECT_EQ(threads_with(folder.path("many.glb"), "1"), idle);
  EXPECT_GT(threads_with(folder.path("many.glb"), "2"), idle);
}

TEST_F(Cli, APictureThatDoesNotFitTheMemoryIsRefused) {
  if (kSanitized) GTEST_SKIP() << "skipped: a sanitizer takes all the address space";
  // 4 GB of address space; rendering takes 34.
  EXPECT_EQ(run("render furnace -q --width 16384 --samples 1 -o " + folder.path("a.exr"), RLIM_INFINITY, 1ull << 32),
            1);
  expect_one_error();
  EXPECT_NE(err.find("needs 34.4 GB of memory"), std::string::npos) << err;
}

TEST_F(Cli, AKilledRenderLeavesNoFile) {
  Ods command({"render", "furnace", "--width", "2048", "--samples", "100000", "-o", folder.path("a.png")});
  command.wait_for("camera at");
  command.kill(SIGKILL);
  EXPECT_EQ(command.finish(), 1000 + SIGKILL) << command.err;
  EXPECT_EQ(files(), 0u);
}

TEST_F(Cli, TwoRendersOfOneFileDoNotMeet) {
  const std::vector<std::string> words = {"render", "furnace", "--width",           "64", "--samples", "4",
                                          "-q",     "-o",      folder.path("a.png")};
  EXPECT_EQ(Ods(words).finish(), 0);
  const std::string alone = folder.read("a.png");
  Ods one(words), other(words);
  EXPECT_EQ(one.finish(), 0) << one.err;
  EXPECT_EQ(other.finish(), 0) << other.err;
  EXPECT_EQ(folder.read("a.png"), alone);
  EXPECT_EQ(files(), 1u);
}

TEST_F(Cli, AFullStdoutIsAnOutputError) {
  for (const std::string& words : {std::string("scenes"), render()}) {
    const std::string command = ods_command() + " " + words + " >/dev/full 2>/dev/null";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 4) << words;
  }
}

TEST_F(Cli, WhatIsPrintedToAClosedStreamDoesNotEndInThePicture) {
  EXPECT_EQ(run(render()), 0) << err;
  const std::string picture = folder.read("picture.png");
  const std::string command = ods_command() + " " + render() + " <&- >&- 2>&-";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 0);
  EXPECT_EQ(folder.read("picture.png"), picture);
}

TEST_F(Cli, ASidecarStandsBesideItsPictureAndIsReadBack) {
  EXPECT_EQ(run(render("--sidecar --position 0,0,0.1 --yaw 30 --merge cosine,60,75")), 0) << err;
  EXPECT_EQ(out, folder.path("picture.png") + "\n" + folder.path("picture.camera.json") + "\n");
  EXPECT_EQ(run("camera --for blender -q --camera-file " + folder.path("picture.camera.json")), 0) << err;
  EXPECT_NE(out.find("pole_merge_angle_to = radians(75)"), std::string::npos) << out;
  EXPECT_NE(out.find("resolution_x = 16\n"), std::string::npos) << out;
  EXPECT_EQ(run("camera --for json --yaw 40 --camera-file " + folder.path("picture.camera.json")), 0) << err;
  EXPECT_NE(out.find("\"yaw\": 40.0"), std::string::npos) << "what is given goes before what the file says" << out;
}

TEST_F(Cli, CamerasAreExportedOrRefusedInALine) {
  EXPECT_EQ(run("camera --for povray -o " + folder.path("camera.inc")), 0) << err;
  EXPECT_NE(folder.read("camera.inc").find("user_defined"), std::string::npos);
  EXPECT_EQ(out, folder.path("camera.inc") + "\n");
  EXPECT_EQ(run("camera --for blender --eye-to-neck 0.1"), 0);
  EXPECT_NE(err.find("unsupported: "), std::string::npos) << err;
  EXPECT_NE(out.find("# Unsupported: Blender has no eye-to-neck"), std::string::npos) << out;
  folder.write("new.json", "{\"omnistereo_camera\": 7}");
  EXPECT_EQ(run("camera --for json --camera-file " + folder.path("new.json")), 3);
  EXPECT_NE(err.find("newer ods"), std::string::npos) << err;
  std::filesystem::remove(folder.path("new.json"));
  std::filesystem::remove(folder.path("camera.inc"));
  EXPECT_EQ(run("camera --for povray-fork --pitch 5"), 2);
  expect_one_error();
}

TEST_F(Cli, PointsAreProjectedAndComeBack) {
  EXPECT_EQ(run("project 0,0,-0.65 0.01,0,0 --width 4096"), 0) << err;
  // 0.65 m ahead: asin(1/20) of a turn to the right in the left eye.
  EXPECT_NE(out.find("0,0,-0.65  left   pixel 2080.609 1024.000"), std::string::npos) << out;
  EXPECT_NE(out.find("0.01,0,0  right  not seen"), std::string::npos) << out;
  EXPECT_EQ(run("project --width 4096 --from-pixel left,2080.6087,1024,0.64918698"), 0) << err;
  float x = 1, y = 1, z = 1;
  ASSERT_EQ(std::sscanf(out.c_str(), "%f,%f,%f", &x, &y, &z), 3) << out;
  EXPECT_NEAR(x, 0.0f, 1e-6f);
  EXPECT_NEAR(y, 0.0f, 1e-6f);
  EXPECT_NEAR(z, -0.65f, 1e-6f);
  EXPECT_EQ(run("project -1,-2,-3 --json"), 0) << err;
  EXPECT_TRUE(out.starts_with("{\"point\":[-1.0,-2.0,-3.0],\"left\":{\"seen\":true,")) << out;
  for (const char* words : {"project 1,2", "project nan,0,0", "project --from-pixel left,1,2",
                            "project --from-pixel left,99999,2,1", "project --from-pixel up,1,2,3"}) {
    EXPECT_EQ(run(words), 2) << words;
    expect_one_error();
  }
}

TEST_F(Cli, ATestcardTakesEveryForm) {
  const std::string card = folder.path("card");
  EXPECT_EQ(run("testcard --layout multiview --width 64 --sidecar -o " + card + ".exr"), 0) << err;
  EXPECT_EQ(out, card + ".exr\n" + card + ".camera.json\n");
  EXPECT_EQ(run("testcard --size tb-quick-test-512 -o " + card + "_b.png"), 0) << err;
  EXPECT_NE(err.find("2 pixels high and cannot be read: use --width 1536 or more"), std::string::npos) << err;
  EXPECT_EQ(run("compare --max-error 0 " + card + "_b.png " + card + "_b.png"), 0) << err;
  for (const auto& [words, code] : std::vector<std::pair<std::string, int>>{
           {"", 2}, {" --projection cube-3x2 --width 100 -o " + card + "_.png", 2}, {" -o " + card + ".xyz", 2}}) {
    EXPECT_EQ(run("testcard" + words), code);
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
  }
}

TEST_F(Cli, LintTellsByItsExitCode) {
  const std::string picture = folder.path("axis.png");
  ASSERT_EQ(run("render axis --width 512 --samples 4 --filter box -o " + picture), 0) << err;
  EXPECT_EQ(run("lint " + picture), 0) << out << err;
  EXPECT_TRUE(out.ends_with("no fault found in what was judged\n")) << out;
  EXPECT_NE(out.find("\njudged: the layout of the eyes, "), std::string::npos) << out;
  EXPECT_NE(out.find(", height, pitch, roll and size between the eyes, "), std::string::npos) << out;
  EXPECT_NE(out.find("\nnot judged: time between the eyes, cuts, duplicate frames (one picture has no time)\n"),
            std::string::npos)
      << out;
  EXPECT_EQ(run("lint --json " + picture), 0) << err;
  EXPECT_NE(out.find(R"("check": "time between the eyes")"), std::string::npos) << out;
  const std::string swapped = "lint --layout bottom-top " + picture;
  EXPECT_EQ(run(swapped), 5) << out;
  EXPECT_NE(out.find("fault eyes-swapped: "), std::string::npos) << out;
  EXPECT_EQ(run(swapped + " --json"), 5);
  EXPECT_NE(out.find("\"fault\": \"eyes-swapped\""), std::string::npos) << out;
  EXPECT_EQ(run(swapped + " --min-certainty 1"), 0) << out;
  // The remedy is a command that works.
  const std::string wrong = folder.path("wrong_TB.png"), fixed = folder.path("fixed_TB.png");
  ASSERT_EQ(run("convert " + picture + " -o " + wrong + " --right-raise 2 --right-roll -3"), 0) << err;
  EXPECT_EQ(run("lint " + wrong), 5) << out;
  EXPECT_EQ(err, "") << "a verdict is not an error";
  EXPECT_NE(out.find("fault vertical-offset: "), std::string::npos) << out;
  const size_t remedy = out.find("ods convert " + wrong + " -o corrected.png ") + 4;
  std::string command = out.substr(remedy, out.find(".\n", remedy) - remedy);
  command.replace(command.find("corrected.png"), 13, fixed);
  ASSERT_EQ(run(command), 0) << command << err;
  EXPECT_EQ(run("lint " + fixed), 0) << command << out;
  EXPECT_EQ(run("lint " + folder.path("absent.png")), 3);
  EXPECT_EQ(run("lint"), 2);
}

}  // namespace ods::cli_test
