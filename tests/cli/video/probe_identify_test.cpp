// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Files without metadata and telling names, given to the commands: they are identified by their pixels, or the message
// lists the possible readings and the options that decide.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/cli_runner.h"
#include "tests/support/unknown_files.h"

namespace ods::identify_command_test {

using ods::Layout, ods::Truth;

class IdentifyInput : public Cli {
 protected:
  // A picture as a camera with two lenses writes it.
  void write(const std::string& name, std::optional<Layout> layout, const char* projection, int width = 512) const {
    const ods::TwoEyes eyes = [](int eye, const ods::ProjectionSetting& setting, ods::Extent size) {
      ods::StereoCamera camera;
      camera.projection = setting;
      return seen_in(ods::World::kHall, camera, eye, size, true);
    };
    const ods::ProjectionSetting setting = ods::find_projection(projection)->setting;
    write_unknown(folder.path(name), {layout, setting}, eyes, ods::unknown_eye(setting, width));
  }

  nlohmann::json probe(const std::string& name) {
    EXPECT_EQ(run("probe " + folder.path(name) + " --json"), 0) << err;
    return nlohmann::json::parse(out).at("picture");
  }
};

// A public VR180 photo of two square eyes, one above the other, was taken for one eye.
TEST_F(IdentifyInput, AVr180PhotoOfTwoSquaresIsRecognised) {
  write("photo.jpg", Layout::kTopBottom, "vr180");
  const nlohmann::json picture = probe("photo.jpg");
  EXPECT_EQ(picture.at("layout"), "top-bottom");
  EXPECT_EQ(picture.at("projection"), "vr180");
  ASSERT_FALSE(picture.at("readings").empty());
  EXPECT_EQ(picture.at("readings").at(0).at("layout"), "top-bottom");
  EXPECT_GT(picture.at("readings").at(0).at("certainty").get<double>(), 0.5);

  EXPECT_EQ(run("convert " + folder.path("photo.jpg") + " -o " + folder.path("to.png") + " --to fisheye"), 0) << err;
  EXPECT_NE(err.find("vr180: its pixels look like it"), std::string::npos) << err;
  EXPECT_NE(err.find("top-bottom"), std::string::npos) << err;

  const int code = run("lint " + folder.path("photo.jpg") + " --json");
  EXPECT_TRUE(code == 0 || code == 5) << err;
  EXPECT_EQ(nlohmann::json::parse(out).at("layout"), "top-bottom") << out;
  EXPECT_EQ(run("view " + folder.path("photo.jpg") + " --export " + folder.path("site")), 0) << err;
  EXPECT_NE(err.find("vr180: its pixels look like it"), std::string::npos) << err;
}

// A public pair of fisheyes, side by side, was taken for one eye of a wrong shape.
TEST_F(IdentifyInput, APairOfFisheyesIsRecognised) {
  write("lenses.jpg", Layout::kSideBySide, "fisheye");
  const nlohmann::json picture = probe("lenses.jpg");
  EXPECT_EQ(picture.at("layout"), "side-by-side");
  EXPECT_EQ(picture.at("projection"), "fisheye");

  EXPECT_EQ(run("convert " + folder.path("lenses.jpg") + " -o " + folder.path("to.png") + " --to vr180"), 0) << err;
  EXPECT_NE(err.find("fisheye: its pixels look like it"), std::string::npos) << err;
  const int code = run("lint " + folder.path("lenses.jpg") + " --json");
  EXPECT_TRUE(code == 0 || code == 5) << err;
  EXPECT_EQ(nlohmann::json::parse(out).at("layout"), "side-by-side") << out;
  EXPECT_EQ(run("view " + folder.path("lenses.jpg") + " --export " + folder.path("site")), 0) << err;
  EXPECT_NE(err.find("fisheye: its pixels look like it"), std::string::npos) << err;
}

// A public film of two squeezed eyes was judged as one eye, and so were its frames.
TEST_F(IdentifyInput, AFilmOfSqueezedEyesAndItsFramesAreRecognised) {
  write("frame.0001.png", Layout::kSideBySideHalf, "lat-long", 1024);
  const std::string tagged = folder.path("tagged_360_HSBS.mp4"), film = folder.path("film.mp4");
  const std::string frame_is = "frame.0001.png: lat-long: its pixels look like it";
  ASSERT_EQ(run("encode " + folder.path("frame.####.png") + " -o " + tagged), 0) << err;
  EXPECT_NE(err.find(frame_is), std::string::npos) << err;
  ASSERT_EQ(run("inject " + tagged + " --remove -o " + film), 0) << err;
  const std::string said = "film.mp4' is side-by-side-half, lat-long: its left and right picture match";
  const int code = run("comfort " + film + " --json");
  EXPECT_TRUE(code == 0 || code == 5) << err;
  EXPECT_NE(err.find(said), std::string::npos) << err;
  EXPECT_TRUE(nlohmann::json::parse(out).contains("level")) << out;
  ASSERT_EQ(run("title End --width 64 -o " + folder.path("title.exr")), 0) << err;
  EXPECT_EQ(run("over " + folder.path("title.exr") + " " + film + " -o " + folder.path("titled.mp4")), 0) << err;
  EXPECT_NE(err.find(said), std::string::npos) << err;
  const std::string words = folder.path("title.exr") + " " + folder.path("frame.####.png");
  EXPECT_EQ(run("over " + words + " -o " + folder.path("over.####.png")), 0) << err;
  EXPECT_NE(err.find(frame_is), std::string::npos) << err;
}

// Each command names the readings, and its own options.
TEST_F(IdentifyInput, DoubtNamesTheReadingsAndTheOptions) {
  write("lens.jpg", std::nullopt, "fisheye-equisolid");
  ASSERT_EQ(run("probe " + folder.path("lens.jpg")), 0) << err;
  for (const char* part : {"one eye, fisheye (", "one eye, fisheye-equisolid (", "--layout and --projection"}) {
    EXPECT_NE(out.find(part), std::string::npos) << part << "\n" << out;
  }
  ASSERT_EQ(run("convert " + folder.path("lens.jpg") + " -o " + folder.path("to.png") + " --to vr180"), 0) << err;
  for (const char* part : {"one eye, fisheye (", "one eye, fisheye-equisolid (", "--layout and --projection"}) {
    EXPECT_NE(err.find(part), std::string::npos) << part << "\n" << err;
  }
  EXPECT_EQ(run("inject " + folder.path("lens.jpg")), 3) << err;
  EXPECT_NE(err.find("one eye, fisheye-equisolid ("), std::string::npos) << err;
  EXPECT_EQ(run("inject " + folder.path("lens.jpg") + " --layout mono --projection vr180"), 0) << err;
}

// Words, names and options count more than pixels; then nothing is looked at.
TEST_F(IdentifyInput, NamesAndOptionsDecide) {
  write("lenses_360_TB.jpg", Layout::kSideBySide, "fisheye");
  const nlohmann::json picture = probe("lenses_360_TB.jpg");
  EXPECT_EQ(picture.at("layout"), "top-bottom");
  EXPECT_EQ(picture.at("projection"), "lat-long");
  EXPECT_TRUE(picture.at("readings").is_null());
}

// A file of another kind leads to the commands that take it.
TEST_F(IdentifyInput, FilesOfAnotherKindLeadToTheirCommands) {
  folder.write("scene.glb", "glTF\2");
  folder.write("film.mp4", std::string("\0\0\0\x18"
                                       "ftypisom",
                                       12));
  write("photo.jpg", std::nullopt, "lat-long");
  EXPECT_EQ(run("lint " + folder.path("scene.glb")), 3);
  EXPECT_NE(err.find("it is a scene: ods render"), std::string::npos) << err;
  EXPECT_EQ(run("denoise " + folder.path("film.mp4") + " -o " + folder.path("a.exr")), 3);
  EXPECT_NE(err.find("it is a video"), std::string::npos) << err;
  EXPECT_NE(err.find("lint"), std::string::npos) << err;
  EXPECT_EQ(run("render " + folder.path("photo.jpg") + " -o " + folder.path("a.png")), 3);
  EXPECT_NE(err.find("it is a picture"), std::string::npos) << err;
}

}  // namespace ods::identify_command_test
