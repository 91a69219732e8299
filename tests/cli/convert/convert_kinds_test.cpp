// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Kinds of files from elsewhere that were once read wrongly: all commands give one answer, and a reason.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/cli_runner.h"
#include "tests/support/programs.h"
#include "tests/support/simulated_camera.h"
#include "tests/support/unknown_files.h"

namespace ods::convert_kinds_test {

class ConvertKinds : public Cli {
 protected:
  // Two cameras that look ahead.
  void write_pair(const std::string& name, std::optional<Layout> layout, const char* projection, Extent size) const {
    const TwoEyes eyes = [](int eye, const ProjectionSetting& setting, Extent extent) {
      StereoCamera camera;
      camera.projection = setting;
      return seen_in(World::kHall, camera, eye, extent, true);
    };
    ProjectionSetting setting = find_projection(projection)->setting;
    if (setting.kind == kPerspective) setting.aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
    write_unknown(folder.path(name), {layout, setting}, eyes, size);
  }

  // Two lenses of a camera, in halves of these sizes.
  void write_lenses(const std::string& name, Extent half, float radius, float fov, float second_yaw) const {
    SimulatedCamera camera;
    camera.half = half;
    for (FisheyeLens& lens : camera.lenses) {
      lens.center = 0.5f * vec2(static_cast<float>(half.width), static_cast<float>(half.height));
      lens.radius = radius, lens.fov = fov;
    }
    camera.lenses[1].yaw = second_yaw;
    const LensWorld shown = [&](int which, vec3 direction) {
      // Two eyes: the right one is first.
      const vec3 from(second_yaw == 0.0f ? (which == 0 ? 0.032f : -0.032f) : 0.0f, 0.0f, 0.0f);
      const float light = dot(world_at(World::kHall, from, direction), vec3(0.3f, 0.6f, 0.1f));
      return std::pow(std::clamp(light, 0.0f, 1.0f), 1.0f / 2.2f);
    };
    write_raw_file(folder.path(name), camera, shown, 90);
  }

  nlohmann::json probe(const std::string& name) {
    EXPECT_EQ(run("probe " + folder.path(name) + " --json"), 0) << err;
    return nlohmann::json::parse(out).at("picture");
  }

  static void expect_in(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in: " << text;
  }
};

// Nobody asked for what the circles decide.
TEST_F(ConvertKinds, LensesOfACameraGiveTheReason) {
  write_lenses("glow.jpg", {480, 480}, 236, 195, 180);
  expect_in(probe("glow.jpg").at("reason"), "two fisheyes that look ahead and back, 19");
  ASSERT_EQ(run("probe " + folder.path("glow.jpg")), 0) << err;
  expect_in(out, "two fisheyes, ahead and back: its pixels show");
  EXPECT_EQ(out.find("as asked"), std::string::npos) << out;
  EXPECT_EQ(run("inject " + folder.path("glow.jpg")), 3);
  expect_in(err, "two fisheyes that look ahead and back");

  write_lenses("canon.jpg", {540, 720}, 244, 190, 0);
  const nlohmann::json canon = probe("canon.jpg");
  EXPECT_EQ(canon.at("layout"), "cross-eyed");
  expect_in(canon.at("reason"), "a pair of fisheyes whose circles do not touch the edges, the right eye first");
  ASSERT_EQ(run("convert " + folder.path("canon.jpg") + " -o " + folder.path("c_180_LR.jpg")), 0) << err;
  run("lint " + folder.path("c_180_LR.jpg"));
  EXPECT_EQ(out.find("eyes-swapped"), std::string::npos) << out;
}

// FFmpeg's v360 leaves no corners black.
TEST_F(ConvertKinds, FisheyesThatFillTheirHalvesBecomeASphere) {
  write_lenses("filled.jpg", {480, 480}, 341, 270, 180);
  expect_in(probe("filled.jpg").at("reason"), "look ahead and back");
  EXPECT_EQ(run("convert " + folder.path("filled.jpg") + " -o " + folder.path("world_360.jpg")), 0) << err;
}

TEST_F(ConvertKinds, AnAnaglyphIsFlat) {
  write_pair("red_cyan.jpg", Layout::kAnaglyph, "perspective", {640, 480});
  const nlohmann::json picture = probe("red_cyan.jpg");
  EXPECT_EQ(picture.at("layout"), nullptr);
  EXPECT_EQ(picture.at("projection"), "perspective");
  ASSERT_EQ(run("probe " + folder.path("red_cyan.jpg")), 0) << err;
  expect_in(out, "mono, perspective: nothing tells what it shows: it looks flat");
  expect_in(out, "it may be an anaglyph");
  for (const char* command : {"inject", "convert -o x_LR.jpg"}) {
    EXPECT_EQ(run(std::string(command) + " " + folder.path("red_cyan.jpg")), 3) << command;
    expect_in(err, "anaglyph");
  }
}

// Without detail and with the shape of neither one sphere nor two, a picture looks flat for every command.
TEST_F(ConvertKinds, AShapeOfNoSphereIsFlat) {
  const TwoEyes grey = [](int, const ProjectionSetting&, Extent size) {
    Image image(size.width, size.height, 3);
    std::fill(image.pixels.begin(), image.pixels.end(), 0.2f);
    return image;
  };
  write_unknown(folder.path("grey.jpg"), {std::nullopt, find_projection("perspective")->setting}, grey, {640, 480});
  EXPECT_EQ(probe("grey.jpg").at("projection"), "perspective");
  run("lint " + folder.path("grey.jpg") + " --json");
  EXPECT_EQ(nlohmann::json::parse(out).at("projection"), "perspective");
  EXPECT_EQ(run("convert " + folder.path("grey.jpg") + " -o " + folder.path("x_360.jpg")), 3);
  expect_in(err, "its pixels show too little");
}

TEST_F(ConvertKinds, TheNameOfALensHasItsAngle) {
  write_lenses("toys_FISHEYE190_LR.jpg", {480, 480}, 240, 190, 0);
  EXPECT_EQ(probe("toys_FISHEYE190_LR.jpg").at("projection"), "fisheye");
  ASSERT_EQ(run("convert " + folder.path("toys_FISHEYE190_LR.jpg") + " -o " + folder.path("t_180_LR.jpg")), 0) << err;
  write_lenses("toys_fisheye_LR.jpg", {480, 480}, 240, 190, 0);
  ASSERT_EQ(run("convert " + folder.path("toys_fisheye_LR.jpg") + " --input-fov 190 -o " + folder.path("u_180_LR.jpg")),
            0)
      << err;
  EXPECT_EQ(folder.read("t_180_LR.jpg"), folder.read("u_180_LR.jpg"));
}

TEST_F(ConvertKinds, InterlacedVideosAreToldAndRefused) {
  if (const std::string why = missing("ffmpeg", "ffmpeg -version"); !why.empty()) GTEST_SKIP() << why;
  const std::string path = folder.path("fields_360_TB.mp4");
  ASSERT_EQ(run_line("ffmpeg -v error -f lavfi -i testsrc=s=128x128 -frames:v 4 -c:v libx264 -flags +ildct+ilme "
                     "-x264opts tff=1 -pix_fmt yuv420p " +
                     path)
                .code,
            0);
  ASSERT_EQ(run("probe " + path), 0) << err;
  expect_in(out, "its pictures are interlaced; ffmpeg -i");
  EXPECT_EQ(run("convert " + path + " -o " + folder.path("i_180_LR.mp4") + " --to vr180"), 3);
  expect_in(err, "its pictures are interlaced; ffmpeg -i");
}

}  // namespace ods::convert_kinds_test
