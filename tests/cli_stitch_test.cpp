// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// From a scene to a stitched picture, as its user goes.
#include <gtest/gtest.h>

#include <filesystem>

#include "ods/image/load_eyes.h"
#include "ods/video/film.h"
#include "tests/cli_runner.h"

namespace {

class CliStitch : public Cli {
 protected:
  std::string rig = folder.path("rig.json");
  std::string views = folder.path("views/####.exr");

  int plan(const std::string& words = "--slits 12 --width 64") {
    return run("rig --position 0,1.6,0 " + words + " -o " + rig);
  }
  int render() { return run("render axis -q --samples 4 --rig " + rig + " -o " + views); }
  int stitch(const std::string& name, const std::string& words = "") {
    return run("stitch " + rig + " " + views + " -o " + folder.path(name) + " -q " + words);
  }
};

TEST_F(CliStitch, ARigBecomesAPicture) {
  ASSERT_EQ(plan(), 0) << err;
  EXPECT_NE(out.find("12 slits of 2 views for 2 eyes: 48 views"), std::string::npos) << out;
  ASSERT_EQ(render(), 0) << err;
  ASSERT_EQ(stitch("picture.exr", "--report " + folder.path("seams.png")), 0) << err;
  EXPECT_EQ(err, "");
  EXPECT_EQ(out, folder.path("picture.exr") + "\n" + folder.path("seams.png") + "\n");
  const ods::StoredPicture made = ods::open_picture(folder.path("picture.exr"));
  EXPECT_EQ(made.size.width, 64);
  EXPECT_EQ(made.eyes.size(), 2u);
  EXPECT_FLOAT_EQ(made.rig.position.y, 1.6f);
  EXPECT_FALSE(std::filesystem::exists(folder.path("picture.exr.stitching")));
}

TEST_F(CliStitch, Vr180LiesSideBySide) {
  ASSERT_EQ(plan("--slits 12 --width 64 --projection vr180"), 0) << err;
  EXPECT_NE(folder.read("rig.json").find("\"side-by-side\""), std::string::npos);
  ASSERT_EQ(render(), 0) << err;
  ASSERT_EQ(stitch("picture.exr"), 0) << err;
  EXPECT_EQ(ods::open_picture(folder.path("picture.exr")).layout, ods::Layout::kSideBySide);
  ASSERT_EQ(stitch("told.exr", "--layout top-bottom"), 0) << err;
  EXPECT_EQ(ods::open_picture(folder.path("told.exr")).layout, ods::Layout::kTopBottom);
}

TEST_F(CliStitch, ScriptsStandBesideTheRig) {
  ASSERT_EQ(plan("--slits 12 --width 64 --depth plane --for povray,csv"), 0) << err;
  const std::string base = folder.path("rig");
  EXPECT_TRUE(out.ends_with("\n" + rig + "\n" + base + ".povray.inc\n" + base + ".povray.ini\n" + base + ".csv\n"))
      << out;
  EXPECT_EQ(folder.names().size(), 4u);
  EXPECT_NE(err.find("--for povray: this writes no depth"), std::string::npos) << err;
  EXPECT_EQ(run("rig --slits 12 --width 64 --for csv"), 2);
  EXPECT_NE(err.find("-o rig.json"), std::string::npos) << err;
  EXPECT_EQ(plan("--for blender,max"), 2);
  EXPECT_NE(err.find("'max' is none of blender, povray"), std::string::npos) << err;
}

TEST_F(CliStitch, ViewsThatAreMissingAreSaidTogether) {
  ASSERT_EQ(plan(), 0) << err;
  ASSERT_EQ(render(), 0) << err;
  for (const char* name : {"views/0003.exr", "views/0004.exr", "views/0020.exr"}) {
    std::filesystem::remove(folder.path(name));
  }
  folder.write("views/0040.exr", "damaged");
  EXPECT_EQ(run("stitch " + rig + " " + views + " --list-missing"), 0) << err;
  EXPECT_EQ(out, "3-4,20,40\n");
  EXPECT_EQ(stitch("picture.exr"), 3);
  EXPECT_NE(err.find("3 of 48 views"), std::string::npos) << err;
  EXPECT_NE(err.find("3-4,20"), std::string::npos) << err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("picture.exr")));
  EXPECT_EQ(stitch("picture.png", "--partial"), 0) << err;
  EXPECT_EQ(run("render axis -q --samples 4 --skip-existing --rig " + rig + " -o " + views), 0) << err;
  EXPECT_EQ(stitch("picture.exr"), 3);
  EXPECT_NE(err.find("40"), std::string::npos) << err;
}

TEST_F(CliStitch, FramesBecomeAFilm) {
  ASSERT_EQ(plan("--slits 6 --width 64"), 0) << err;
  for (const char* frame : {"1", "2"}) {
    const std::string to = folder.path(std::string("views.") + frame + "/####.png");
    ASSERT_EQ(run("render axis -q --samples 1 --rig " + rig + " -o " + to), 0) << err;
  }
  const std::string of = folder.path("views.#/####.png") + " ";
  ASSERT_EQ(run("stitch " + rig + " " + of + "--frames 1-2 -q -o " + folder.path("shot.#.png")), 0) << err;
  EXPECT_EQ(out, folder.path("shot.1.png") + "\n" + folder.path("shot.2.png") + "\n");
  ASSERT_EQ(run("film " + of + "--rig " + rig + " --frames 1-2 -q -o " + folder.path("film_360_TB.mkv")), 0) << err;
  const ods::FilmInfo film = ods::read_film(folder.path("film_360_TB.mkv"));
  ASSERT_EQ(film.video.size(), 1u);
  EXPECT_EQ(film.video[0].size.height, 64);
  EXPECT_EQ(form_text(*film.video[0].v2), "top-bottom, lat-long");
  EXPECT_EQ(run("film " + of + "--rig " + rig + " -q -o " + folder.path("b.mkv")), 2);
}

TEST_F(CliStitch, ExitCodesSayWhatWasWrong) {
  EXPECT_EQ(run("rig --slits 12 --width 66 --projection cube-3x2"), 2);
  EXPECT_NE(err.find("lat-long"), std::string::npos) << err;
  EXPECT_EQ(run("rig --width 64 --merge cosine,60,90 --max-error 0.01"), 3);
  EXPECT_EQ(run("stitch " + rig + " x.exr -o y.exr"), 3);
  folder.write("rig.json", "{\"omnistereo_slits\": 1}");
  EXPECT_EQ(stitch("y.exr"), 3);
  ASSERT_EQ(plan(), 0) << err;
  EXPECT_EQ(run("stitch " + rig + " x.exr -o y.exr"), 2);
  EXPECT_NE(err.find("####"), std::string::npos) << err;
  EXPECT_EQ(stitch("y.exr"), 3);  // no view is there
  EXPECT_EQ(run("render axis --rig " + rig + " -o " + views + " --width 100"), 2);
}

}  // namespace
