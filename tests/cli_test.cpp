// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The command as its user meets it: what it writes, where, and how it ends.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <vector>

#include "tests/temporary_folder.h"

namespace {

// A running ods, its stdout and stderr in pipes.
class Ods {
 public:
  explicit Ods(std::vector<std::string> arguments, rlim_t largest_file = RLIM_INFINITY) {
    arguments.insert(arguments.begin(), ODS_COMMAND);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    EXPECT_EQ(pipe2(out_.data(), O_CLOEXEC), 0);
    EXPECT_EQ(pipe2(err_.data(), O_CLOEXEC), 0);
    pid_ = fork();
    if (pid_ == 0) {
      dup2(out_[1], STDOUT_FILENO);
      dup2(err_[1], STDERR_FILENO);
      const rlimit limit{largest_file, largest_file};
      setrlimit(RLIMIT_FSIZE, &limit);
      signal(SIGXFSZ, SIG_IGN);  // the write fails, as on a full disk
      execv(argv[0], argv.data());
      _exit(127);
    }
    close(out_[1]);
    close(err_[1]);
  }
  Ods(const Ods&) = delete;
  Ods& operator=(const Ods&) = delete;

  // Reads until stderr says it or ends.
  void wait_for(const std::string& text) {
    while (err.find(text) == std::string::npos && read_some()) {
    }
  }

  void kill(int number) { ::kill(pid_, number); }

  // The exit code; 1000 + the signal that ended it.
  int finish() {
    while (read_some()) {
    }
    int status = 0;
    waitpid(pid_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }

  std::string out;
  std::string err;

 private:
  bool read_some() {
    std::array<pollfd, 2> ends = {pollfd{out_[0], POLLIN, 0}, pollfd{err_[0], POLLIN, 0}};
    poll(ends.data(), ends.size(), -1);
    return read_end(ends[0], out_[0], out) | read_end(ends[1], err_[0], err);
  }

  static bool read_end(const pollfd& polled, int& end, std::string& text) {
    if (end < 0) return false;
    if (polled.revents == 0) return true;
    std::array<char, 4096> bytes{};
    const ssize_t size = read(end, bytes.data(), bytes.size());
    if (size > 0) {
      text.append(bytes.data(), static_cast<size_t>(size));
      return true;
    }
    close(end);
    end = -1;
    return false;
  }

  pid_t pid_ = -1;
  std::array<int, 2> out_{-1, -1};
  std::array<int, 2> err_{-1, -1};
};

class Cli : public ::testing::Test {
 protected:
  // ods with these words, to its end.
  int run(const std::string& words, rlim_t largest_file = RLIM_INFINITY) {
    std::istringstream stream(words);
    std::vector<std::string> arguments;
    for (std::string word; stream >> word;) arguments.push_back(word);
    Ods command(arguments, largest_file);
    const int code = command.finish();
    out = command.out;
    err = command.err;
    return code;
  }

  // A command that renders a picture of next to nothing into the folder.
  std::string render(const std::string& words = "") const {
    return "render furnace --width 16 --samples 1 -o " + folder.path("picture.png") + " " + words;
  }

  size_t files() const { return folder.names().size(); }

  // Nothing but one line, which starts as every error does.
  void expect_one_error() const {
    EXPECT_EQ(out, "");
    EXPECT_TRUE(err.starts_with("ods: error: ")) << err;
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    EXPECT_EQ(err.find_first_of("\r\x1b"), std::string::npos) << "colours and cursors are for terminals";
    EXPECT_EQ(files(), 0u);
  }

  ods::TemporaryFolder folder;
  std::string out;
  std::string err;
};

TEST_F(Cli, HelpStartsWithExamples) {
  for (const char* words : {"--help", "-h", "help", "render --help", "info --help", "camera --help", "project --help",
                            "compare --help", "sizes --help", "scenes --help"}) {
    EXPECT_EQ(run(words), 0) << words;
    EXPECT_EQ(err, "") << words;
    EXPECT_NE(out.find("Examples:\n  ods "), std::string::npos) << words;
    EXPECT_LT(out.find("Examples:"), std::min(out.find("Usage:"), out.find("Commands:"))) << words;
  }
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
  for (const char* part : {"ods 0", "Embree 3", "OpenImageIO 2", "oneTBB 202", "tinygltf 2", "fmt ", "CLI11 2"}) {
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

TEST_F(Cli, ANamedSizeSetsWidthAndLayout) {
  const std::string small = " --quality draft --samples 1 --eyes mono";
  EXPECT_EQ(run("render furnace -q --size tb-quick-test-512" + small + " -o " + folder.path("a.exr")), 0) << err;
  EXPECT_EQ(run("render furnace -q --width 512" + small + " -o " + folder.path("b.exr")), 0) << err;
  EXPECT_EQ(folder.read("a.exr"), folder.read("b.exr"));
  EXPECT_EQ(run("render furnace -q --width 16 --size lr-low-7200 --samples 1 -o " + folder.path("c.exr")), 0) << err;
  EXPECT_EQ(run("compare " + folder.path("c.exr") + " " + folder.path("c.exr")), 0) << err;
  EXPECT_NE(out.find("side-by-side, the file says so"), std::string::npos) << out;
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
    EXPECT_EQ(run(a + folder.path("c_SBS.png") + " " + limit), 1) << limit;
    EXPECT_NE(err.find(limit), std::string::npos) << err;
  }
  EXPECT_EQ(run(a + folder.path("c_SBS.png") + " --diff " + folder.path("d.exr")), 0) << err;
  EXPECT_EQ(run(a + folder.path("d.exr") + " --min-psnr 100"), 1) << err;
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

TEST_F(Cli, BadOptionsAreUsageErrors) {
  for (const char* words : {"--width 0",
                            "--width 17",
                            "--width -2",
                            "--width 1e9",
                            "--width 99999999999999999999",
                            "--width x",
                            "--width 8.5",
                            "--samples 0",
                            "--samples -5",
                            "--bounces -1",
                            "--seed -1",
                            "--threads -1",
                            "--ipd nan",
                            "--ipd -0.1",
                            "--ipd inf",
                            "--env nan",
                            "--env 1,2",
                            "--env -1",
                            "--env 1,1,1,1",
                            "--position 1,2",
                            "--position a,b,c",
                            "--position nan,0,0",
                            "--yaw nan",
                            "--yaw ninety",
                            "--eyes three",
                            "--layout diagonal",
                            "--layout mono",
                            "--size huge",
                            "--size tb-1440p-2560",
                            "--tone loud",
                            "--filter tent",
                            "--quality best",
                            "--exposure inf",
                            "--merge cubic",
                            "--merge cosine,80,60",
                            "--merge cosine,10,95",
                            "--merge cosine,",
                            "--merge ,",
                            "--merge cosine,60,90,0",
                            "--merge cosine,60,90,1,1",
                            "--merge-top nan",
                            "--progress loudly",
                            "--camera nowhere",
                            "--camera=",
                            "--env=",
                            "--scene -1",
                            "--scene 0.5",
                            "--unknown",
                            "surplus",
                            "--width"}) {
    EXPECT_EQ(run(render(words)), 2) << words;
    expect_one_error();
  }
  EXPECT_EQ(run("render"), 2);
  EXPECT_EQ(run("render furnace"), 2);
  expect_one_error();
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
    EXPECT_EQ(run(hours + output), 4) << output;
    expect_one_error();
  }
}

TEST_F(Cli, AFullDiskLeavesNoFile) {
  for (const char* name : {"picture.png", "picture.exr", "picture.jpg", "picture.tif", "picture.hdr", "picture.webp"}) {
    EXPECT_EQ(run("render furnace -q --width 64 --samples 1 -o " + folder.path(name), 64), 4) << name;
    expect_one_error();
  }
}

TEST_F(Cli, StdoutHoldsTheFileAndNothingElse) {
  EXPECT_EQ(run(render("--progress plain")), 0) << err;
  EXPECT_EQ(out, folder.path("picture.png") + "\n");
  EXPECT_NE(err.find("ods: camera at "), std::string::npos) << err;
  EXPECT_EQ(files(), 1u);
}

TEST_F(Cli, QuietIsQuiet) {
  EXPECT_EQ(run(render("-q")), 0);
  EXPECT_EQ(err, "");
}

TEST_F(Cli, EveryEyeItsFile) {
  EXPECT_EQ(run("render furnace -q --width 16 --samples 1 -o " + folder.path("eye_%V.png")), 0) << err;
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
    Ods command({"render", "furnace", "--width", "2048", "--samples", "100000", "--progress", "json", "-o",
                 folder.path("a.png")});
    command.wait_for("camera at");
    command.kill(number);
    EXPECT_EQ(command.finish(), 128 + number) << command.err;
    EXPECT_EQ(command.out, "");
    EXPECT_NE(command.err.find("ods: interrupted"), std::string::npos) << command.err;
    EXPECT_EQ(files(), 0u);
  }
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
    const std::string command = std::string(ODS_COMMAND) + " " + words + " >/dev/full 2>/dev/null";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 4) << words;
  }
}

TEST_F(Cli, WhatIsPrintedToAClosedStreamDoesNotEndInThePicture) {
  EXPECT_EQ(run(render()), 0) << err;
  const std::string picture = folder.read("picture.png");
  const std::string command = std::string(ODS_COMMAND) + " " + render() + " <&- >&- 2>&-";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 0);
  EXPECT_EQ(folder.read("picture.png"), picture);
}

TEST_F(Cli, ASidecarStandsBesideItsPictureAndIsReadBack) {
  EXPECT_EQ(run(render("--sidecar --position 0,0,0.1 --yaw 30 --merge cosine,60,75")), 0) << err;
  EXPECT_EQ(out, folder.path("picture.png") + "\n" + folder.path("picture.camera.json") + "\n");
  EXPECT_EQ(run("camera --for blender -q --from " + folder.path("picture.camera.json")), 0) << err;
  EXPECT_NE(out.find("pole_merge_angle_to = radians(75)"), std::string::npos) << out;
  EXPECT_NE(out.find("resolution_x = 16\n"), std::string::npos) << out;
  EXPECT_EQ(run("camera --for json --yaw 40 --from " + folder.path("picture.camera.json")), 0) << err;
  EXPECT_NE(out.find("\"yaw\": 40.0"), std::string::npos) << "what is given goes before what the file says" << out;
}

TEST_F(Cli, CamerasAreExportedOrRefusedInALine) {
  EXPECT_EQ(run("camera --for povray -o " + folder.path("camera.inc")), 0) << err;
  EXPECT_NE(folder.read("camera.inc").find("user_defined"), std::string::npos);
  EXPECT_EQ(out, folder.path("camera.inc") + "\n");
  EXPECT_EQ(run("camera --for unity --neck 0.1"), 0);
  EXPECT_NE(err.find("not as asked"), std::string::npos) << err;
  EXPECT_NE(out.find("// Not as asked: Unity has no eye-to-neck"), std::string::npos) << out;
  folder.write("new.json", "{\"omnistereo_camera\": 7}");
  EXPECT_EQ(run("camera --for json --from " + folder.path("new.json")), 3);
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

}  // namespace
