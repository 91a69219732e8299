// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The command's answers to wrong options, and to the options that every command has.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "ods/base/json_reader.h"
#include "ods/camera/camera_fields.h"
#include "ods/files/atomic_file.h"
#include "ods/image/image_file.h"
#include "ods/picture/metadata/sidecar.h"
#include "tests/support/cli_runner.h"

namespace ods::cli_options_test {

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
  const std::string tiny = " --width 32 --samples 1 ", png = at("p_TB.png"), video = at("f_360_TB.mp4");
  const std::vector<Quiet> commands = {
      {"render furnace" + tiny + "-o " + png},
      {"render furnace --sidecar" + tiny + "-o " + at("eye_%V.png")},
      {"render furnace" + tiny + "--frames 0-1 -o " + at("f.####.png")},
      {"render furnace" + tiny + "--transparent --eyes mono -o " + at("front.exr")},
      {"render furnace" + tiny + "--eyes mono -o " + at("back.exr")},
      {"render axis --width 512 --samples 1 --filter box -o " + at("axis_TB.png")},
      {"convert " + png + " -o " + at("c.png")},
      {"encode " + at("f.####.png") + " -o " + video},
      {"video furnace --duration 0.1" + tiny + "-o " + at("video.mp4")},
      {"title X --width 64 --text-height 3 -o " + at("title.exr")},
      {"over " + at("front.exr") + " " + at("back.exr") + " -o " + at("over.png")},
      {"rig --nearest 1 --width 64 -o " + at("rig.json") + " --for blender"},
      {"rig --nearest 1 --width 64", true},
      {"render furnace --samples 1 --rig " + at("rig.json") + " -o " + at("v.####.exr")},
      {"stitch " + at("rig.json") + " " + at("v.####.exr") + " -o " + at("s.png")},
      {"stitch " + at("rig.json") + " " + at("w.####.exr") + " --list-missing", true},
      {"inject " + video},
      {"inject " + at("back.exr")},
      {"testcard --width 64 -o " + at("card.png")},
      {"testcard --width 64 --duration 0.1 -o " + at("card.mp4")},
      {"camera --for blender --eye-to-neck 0.1 -o " + at("camera.txt")},
      {"camera --for blender --eye-to-neck 0.1", true},
      {"project 0,0,-1", true},
      {"compare " + png + " " + at("c.png"), true},
      {"lint " + at("axis_TB.png"), true},
      {"probe " + video, true},
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
                            "--camera-preset cycles:cheese=1",
                            "--camera-preset cheese",
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

TEST_F(Cli, AMisleadingNameIsReportedOnce) {
  for (const auto& [name, more] :
       {std::pair<std::string, std::string>{"a_180_LR.png", ""}, {"a_180_LR.####.png", " --frames 1 --turntable 1"}}) {
    ASSERT_EQ(run("render furnace --width 16 --samples 1 -o " + folder.path(name) + more), 0) << err;
    const size_t at = err.find("its name ends in _LR, but it is top-bottom: other programs will rely on the name");
    EXPECT_NE(at, std::string::npos) << err;
    EXPECT_EQ(err.find("programs will rely on the name", at + 80), std::string::npos) << err;
  }
}

// The command line accepts every camera that files accept, and writes it into them unchanged.
TEST_F(Cli, CamerasAtTheEndsOfTheirRangesComeBack) {
  const std::string sidecar = folder.path("a.camera.json");
  for (const bool maximum : {false, true}) {
    for (const std::string projection : {"lat-long", "fisheye", "perspective"}) {
      ods::StereoCamera camera;
      camera.projection = ods::find_projection(projection)->setting;
      camera.top.mode = camera.bottom.mode = ods::kMergeCosine, camera.convergence = ods::kToeIn;
      std::string words;
      for (const ods::CameraFieldRow& row : ods::camera_fields()) {
        const bool derived = std::set<std::string_view>{"aspect", "range", "fov"}.contains(row.setting) ||
                             row.name.ends_with("merge start") || row.name.ends_with("merge end");
        for (float* number : row.numbers(camera))
          *number = derived ? *number : maximum ? row.range.maximum : row.range.minimum;
      }
      const bool lens = projection != "lat-long";
      if (lens) camera.projection.fov = projection == "fisheye" ? (maximum ? 360.0f : 1.0f) : maximum ? 170.0f : 0.001f;
      if (!lens) camera.projection.pan = camera.projection.tilt = 0.0f;
      if (!lens) camera.projection.longitude = maximum ? ods::vec2(35640, 36000) : ods::vec2(-36000, -35999);
      std::map<std::string_view, std::string> given;
      for (const ods::CameraModeRow& row : ods::camera_modes()) given[row.setting] = mode_of(camera, row);
      for (const ods::CameraFieldRow& row : ods::camera_fields()) {
        if (row.setting == "aspect" || (row.setting != "lens" && !row.matters(camera))) continue;
        std::string& value = given[row.setting];
        for (const float number : values_of(camera, row))
          value += fmt::format("{}{}", value.empty() ? "" : ",", number);
      }
      for (const auto& [setting, value] : given) words += fmt::format(" --{} {}", setting, value);
      ASSERT_EQ(run("camera --for json --width 64 --projection " + projection + " " + words + " -o " + sidecar), 0)
          << words << "\n"
          << err;
      std::vector<std::string> warnings;
      const ods::Sidecar back = ods::load_sidecar(sidecar, warnings);
      camera.projection.aspect = back.camera.projection.aspect;
      EXPECT_EQ(back.camera, camera) << words;
      ASSERT_EQ(run("camera --for json --camera-file " + sidecar + " -o " + sidecar), 0) << err;
    }
  }
}

TEST_F(Cli, ALensPolynomialHasItsNumbersAndIsChecked) {
  const std::string sidecar = folder.path("a.camera.json");
  const std::string lens = "camera --for json --width 64 --projection fisheye-polynomial ";
  ASSERT_EQ(run(lens + "--fov 100 --sensor 20,10 --lens-polynomial 0,-0.05,0,-1e-5,0 -o " + sidecar), 0) << err;
  std::vector<std::string> warnings;
  const ods::Sidecar back = ods::load_sidecar(sidecar, warnings);
  EXPECT_EQ(back.eye.height, 32) << "of the sensor's shape";
  EXPECT_EQ(back.camera.projection.sensor, ods::vec2(20.0f, 10.0f));
  EXPECT_EQ(back.camera.projection.polynomial, (std::array{0.0f, -0.05f, 0.0f, -1e-5f, 0.0f}));
  std::filesystem::remove(sidecar);
  for (const char* words : {"--lens-polynomial 0,-0.05", "--lens-polynomial 0,0.05,0,0,0", "--sensor 20",
                            "--sensor 0,10", "--lens-polynomial 0,-0.05,0,1e-3,0", "--lens-polynomial a,b,c,d,e"}) {
    EXPECT_EQ(run(lens + words), 2) << words;
    expect_one_error();
  }
  EXPECT_EQ(run("camera --width 64 --projection fisheye --sensor 20,10"), 2);
  EXPECT_NE(err.find("--sensor is for fisheye-polynomial, not for the projection fisheye"), std::string::npos) << err;
}

// A picture of one value, in the code of its file.
void write_grey(const std::string& path, int width, int height, float value) {
  ods::FileHeader header;
  header.format = *ods::format_of_path(path);
  header.width = width, header.height = height;
  const bool is_exr = header.format == ods::FileFormat::kExr;
  for (const char* name : {"R", "G", "B"}) {
    header.channels.push_back({name, is_exr ? ods::SampleType::kFloat : ods::SampleType::kUint8});
  }
  ods::AtomicFile file(path);
  write_image(file, header, [&](int, std::span<float> row) { std::fill(row.begin(), row.end(), value); });
  file.commit();
}

// Half is level as painted, in 8 bits as in floats; white tilts to the right, and the right eye goes down.
TEST_F(Cli, AHeadTiltMapTiltsTheHead) {
  const auto tilt = [&](const std::string& name, float value) {
    write_grey(folder.path(name), 4, 2, value);
    const std::string sidecar = folder.path("a.camera.json");
    EXPECT_EQ(run("camera --for json --width 64 --head-tilt-map " + folder.path(name) + " -o " + sidecar), 0) << err;
    std::vector<std::string> warnings;
    const auto map = ods::load_sidecar(sidecar, warnings).camera.head_tilt_map;
    EXPECT_TRUE(map && map->width == 4 && map->height == 2);
    return map ? map->pixels[5] : NAN;
  };
  EXPECT_EQ(tilt("half.exr", 0.5f), 0.5f);
  EXPECT_NEAR(tilt("grey.png", 128.0f / 255.0f), 128.0f / 255.0f, 1e-6f);
  EXPECT_NEAR(tilt("dark.png", 51.0f / 255.0f), 0.2f, 1e-6f);
  EXPECT_EQ(tilt("black.png", 0.0f), 0.0f);
  EXPECT_EQ(tilt("over.exr", 7.0f), 1.0f);
  EXPECT_EQ(tilt("nan.exr", NAN), 0.5f) << "level";
  EXPECT_NEAR(tilt("white.png", 1.0f), 1.0f, 1e-6f);
  ASSERT_EQ(run("project 0,0,-0.65 --json --width 64 --head-tilt-map " + folder.path("white.png")), 0) << err;
  const ods::Json found = ods::Json::parse(out);
  EXPECT_NEAR(found["right"]["uv"][0].get<double>(), 0.5, 1e-6);
  EXPECT_LT(found["right"]["uv"][1].get<double>(), 0.49) << "seen from below";
  EXPECT_GT(found["left"]["uv"][1].get<double>(), 0.51);
}

// Half the eye distance is half as painted, in 8 bits as in floats.
TEST_F(Cli, AMergeMapIsNumbersAndNotLight) {
  const auto share = [&](const std::string& name, float value, const std::string& more = "") {
    write_grey(folder.path(name), 4, 2, value);
    const std::string sidecar = folder.path("a.camera.json");
    EXPECT_EQ(run("camera --for json --width 64 --merge-map " + folder.path(name) + " -o " + sidecar + more), 0) << err;
    std::vector<std::string> warnings;
    const auto map = ods::load_sidecar(sidecar, warnings).camera.merge_map;
    return map ? map->pixels[5] : NAN;
  };
  EXPECT_EQ(share("half.exr", 0.5f), 0.5f);
  EXPECT_NEAR(share("half.png", 127.0f / 255.0f), 127.0f / 255.0f, 1e-6f);
  EXPECT_NEAR(share("dark.png", 51.0f / 255.0f, " --merge-map-inverted"), 0.8f, 1e-6f);
  EXPECT_EQ(share("nan.exr", NAN), 0.0f);
}

TEST_F(Cli, MapsThatCannotBeReadAreErrorsOfTheirFiles) {
  folder.write("text.png", "no picture");
  write_grey(folder.path("large.png"), 8192, 2049, 0.0f);
  for (const char* option : {"--head-tilt-map ", "--merge-map "}) {
    for (const auto& [name, said] :
         {std::pair{"absent.png", "absent.png"}, {"text.png", "text.png"}, {"large.png", "4096x2048 are enough"}}) {
      EXPECT_EQ(run(std::string("camera --width 64 ") + option + folder.path(name)), 3) << option << name;
      EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
      EXPECT_NE(err.find(said), std::string::npos) << err;
    }
  }
}

TEST_F(Cli, CamerasBeyondTheirRangesAreUsageErrors) {
  for (const char* words : {"--yaw 36001", "--ipd 10001", "--eye-to-neck 1001", "--merge cosine,60,90,1e-7",
                            "--lens 10.1,1", "--convergence toe-in,0.0009", "--range 36000,36010",
                            "--projection perspective --fov 0.0009", "--projection fisheye --lens-direction 0,36001",
                            "--position 1000001,0,0", "--camera-preset arnold:eye_to_neck=1001"}) {
    EXPECT_EQ(run(std::string("camera --width 64 ") + words), 2) << words;
    expect_one_error();
  }
}

TEST_F(Cli, ATitleThatIsTooWideIsWarnedOf) {
  const std::string title = "title The_Long_Way_Home --width 64 -o " + folder.path("a.exr");
  EXPECT_EQ(run(title), 0);
  EXPECT_EQ(err, "");
  EXPECT_EQ(run(title + " --text-height 0.4"), 0);
  EXPECT_NE(err.find("degrees wide"), std::string::npos) << err;
  EXPECT_NE(err.find("--text-height 0.2"), std::string::npos) << err;
}

}  // namespace ods::cli_options_test
