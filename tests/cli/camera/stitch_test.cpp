// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// From a scene to a stitched picture, as its user goes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "ods/image/image_file.h"
#include "ods/picture/load_eyes.h"
#include "ods/video/container/video_file.h"
#include "tests/support/cli_runner.h"
#include "tests/support/pictures.h"

namespace ods::cli_stitch_test {

class StitchCommand : public Cli {
 protected:
  std::string rig = folder.path("rig.json");
  std::string views = folder.path("views/####.exr");

  int plan(const std::string& words = "--slits 12 --width 64") {
    return run("rig --position 0,1.6,0 " + words + " -o " + rig);
  }
  int render() { return run("render axis -q --samples 4 --rig " + rig + " -o " + views); }
  int stitch(const std::string& name, const std::string& words = "") {
    return run("stitch " + rig + " " + views + " -o " + folder.path(name) + " --progress none " + words);
  }
};

TEST_F(StitchCommand, ARigBecomesAPicture) {
  ASSERT_EQ(plan(), 0) << err;
  EXPECT_NE(out.find("12 slits of 2 views for 2 eyes: 48 views"), std::string::npos) << out;
  EXPECT_NE(out.find("\n  elevation           85     75     60     30      0    -30"), std::string::npos) << out;
  EXPECT_NE(out.find("\n  columns "), std::string::npos) << out;
  ASSERT_EQ(render(), 0) << err;
  ASSERT_EQ(stitch("picture.exr", "--report " + folder.path("seams.png")), 0) << err;
  EXPECT_TRUE(err.starts_with("ods: seam visibility ")) << err;
  EXPECT_EQ(out, folder.path("picture.exr") + "\n" + folder.path("seams.png") + "\n");
  const ods::StoredPicture made = ods::open_picture(folder.path("picture.exr"));
  EXPECT_EQ(made.size.width, 64);
  EXPECT_EQ(made.eyes.size(), 2u);
  EXPECT_FLOAT_EQ(made.camera.position.y, 1.6f);
  EXPECT_FALSE(std::filesystem::exists(folder.path("picture.exr.stitching")));
}

TEST_F(StitchCommand, Vr180LiesSideBySide) {
  ASSERT_EQ(plan("--slits 12 --width 64 --projection vr180"), 0) << err;
  EXPECT_NE(folder.read("rig.json").find("\"side-by-side\""), std::string::npos);
  ASSERT_EQ(render(), 0) << err;
  ASSERT_EQ(stitch("picture.exr"), 0) << err;
  EXPECT_EQ(ods::open_picture(folder.path("picture.exr")).layout, ods::Layout::kSideBySide);
  ASSERT_EQ(stitch("told.exr", "--layout top-bottom"), 0) << err;
  EXPECT_EQ(ods::open_picture(folder.path("told.exr")).layout, ods::Layout::kTopBottom);
}

TEST_F(StitchCommand, TheLayoutOfTheRigIsThePictures) {
  ASSERT_EQ(plan("--slits 12 --width 64 --layout bottom-top"), 0) << err;
  ASSERT_EQ(render(), 0) << err;
  ASSERT_EQ(stitch("picture.exr"), 0) << err;
  EXPECT_EQ(ods::open_picture(folder.path("picture.exr")).layout, ods::Layout::kBottomTop);
}

TEST_F(StitchCommand, ScriptsStandBesideTheRig) {
  ASSERT_EQ(plan("--slits 12 --width 64 --depth plane --for povray,csv"), 0) << err;
  const std::string base = folder.path("rig");
  EXPECT_TRUE(out.ends_with("\n" + rig + "\n" + base + ".povray.inc\n" + base + ".povray.ini\n" + base + ".csv\n"))
      << out;
  EXPECT_EQ(folder.names().size(), 4u);
  EXPECT_NE(err.find("--for povray: this export writes no depth"), std::string::npos) << err;
  EXPECT_EQ(run("rig --slits 12 --width 64 --for csv"), 2);
  EXPECT_NE(err.find("-o rig.json"), std::string::npos) << err;
  EXPECT_EQ(plan("--for blender,max"), 2);
  EXPECT_NE(err.find("'max' is not one of blender, povray"), std::string::npos) << err;
}

TEST_F(StitchCommand, MissingViewsAreReportedTogether) {
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

// Views of the same number and size.
TEST_F(StitchCommand, ViewsOfAnotherRigAreRefused) {
  ASSERT_EQ(plan("--slits 12 --width 64 --ipd 0.06"), 0) << err;
  ASSERT_EQ(render(), 0) << err;
  const std::string mark = folder.path("views/ods-rig.txt");
  ASSERT_TRUE(std::filesystem::exists(mark));
  ASSERT_EQ(plan(), 0) << err;
  EXPECT_EQ(stitch("picture.exr"), 3);
  const std::string fault =
      "the views belong to another rig (ipd is 0.06, not 0.065): render them with this rig, or use theirs";
  EXPECT_NE(err.find(mark + "': " + fault), std::string::npos) << err;
  EXPECT_EQ(run("stitch " + rig + " " + views + " --list-missing"), 3);
  EXPECT_EQ(render(), 3) << "a folder is of one rig";
  EXPECT_NE(err.find(mark + "': the views belong to another rig"), std::string::npos) << err;
  std::filesystem::remove(mark);  // the views' own headers record it, too
  EXPECT_EQ(stitch("picture.exr"), 3);
  EXPECT_NE(err.find("0001.exr': " + fault), std::string::npos) << err;
  EXPECT_EQ(run("stitch " + rig + " " + views + " --list-missing"), 0);
  EXPECT_EQ(out, "1-48\n");
  ASSERT_EQ(render(), 0) << err;
  EXPECT_EQ(stitch("picture.exr"), 0) << err;
}

TEST_F(StitchCommand, ViewsThatDoNotSayTheirRigAreNoted) {
  ASSERT_EQ(plan("--slits 6 --width 64"), 0) << err;
  const std::string jpegs = folder.path("views/####.jpg");  // which have no room for a mark
  ASSERT_EQ(run("render axis -q --samples 1 --rig " + rig + " -o " + jpegs), 0) << err;
  ASSERT_EQ(run("stitch " + rig + " " + jpegs + " -o " + folder.path("a.png")), 0) << err;
  EXPECT_EQ(err.find("which rig"), std::string::npos) << err;
  std::filesystem::remove(folder.path("views/ods-rig.txt"));
  ASSERT_EQ(run("stitch " + rig + " " + jpegs + " -o " + folder.path("a.png")), 0) << err;
  EXPECT_NE(err.find("cannot check which rig the views belong to"), std::string::npos) << err;
  folder.write("views/ods-rig.txt", "views of some rig");
  EXPECT_EQ(run("stitch " + rig + " " + jpegs + " -o " + folder.path("a.png")), 3);
  EXPECT_NE(err.find("the mark is damaged"), std::string::npos) << err;
}

// A view of another rig was left in the folder.
TEST_F(StitchCommand, AViewOfAnotherRigIsAtFault) {
  views = folder.path("views/####.png");
  ASSERT_EQ(plan("--slits 12 --width 64 --ipd 0.06"), 0) << err;
  ASSERT_EQ(render(), 0) << err;
  std::filesystem::rename(folder.path("views/0005.png"), folder.path("0005.png"));
  std::filesystem::remove_all(folder.path("views"));
  ASSERT_EQ(plan(), 0) << err;
  ASSERT_EQ(render(), 0) << err;
  std::filesystem::rename(folder.path("0005.png"), folder.path("views/0005.png"));
  EXPECT_EQ(stitch("picture.exr"), 3);
  EXPECT_NE(err.find("1 of 48 views cannot be used: render 5 again"), std::string::npos) << err;
}

TEST_F(StitchCommand, FramesBecomeAVideo) {
  ASSERT_EQ(plan("--slits 6 --width 64"), 0) << err;
  for (const char* frame : {"1", "2"}) {
    const std::string to = folder.path(std::string("views.") + frame + "/####.png");
    ASSERT_EQ(run("render axis -q --samples 1 --rig " + rig + " -o " + to), 0) << err;
  }
  const std::string of = folder.path("views.#/####.png") + " ";
  ASSERT_EQ(run("stitch " + rig + " " + of + "--frames 1-2 --progress none -o " + folder.path("shot.#.png")), 0) << err;
  EXPECT_EQ(out, folder.path("shot.1.png") + "\n" + folder.path("shot.2.png") + "\n");
  ASSERT_EQ(run("video " + of + "--rig " + rig + " --frames 1-2 -q -o " + folder.path("video_360_TB.mkv")), 0) << err;
  const ods::VideoFile video = ods::read_video_file(folder.path("video_360_TB.mkv"));
  ASSERT_EQ(video.tracks.size(), 1u);
  EXPECT_EQ(video.tracks[0].size.height, 64);
  EXPECT_EQ(metadata_text(*video.tracks[0].v2), "top-bottom, lat-long");
  ASSERT_EQ(run("convert " + folder.path("video_360_TB.mkv") + " -q -o " + folder.path("seen.#.png")), 0) << err;
  const auto mean = [&](const char* name) { return ods::mean_of(ods::read_image(folder.path(name))).value(); };
  EXPECT_NEAR(mean("seen.1.png"), mean("shot.1.png"), 0.01) << "these views are display-referred already";
  EXPECT_EQ(run("video " + of + "--rig " + rig + " -q -o " + folder.path("b.mkv")), 2);
}

// The journal is opened for writing: nothing else may be.
TEST_F(StitchCommand, NothingIsWrittenThroughALink) {
  ASSERT_EQ(plan("--slits 6 --width 64"), 0) << err;
  ASSERT_EQ(render(), 0) << err;
  folder.write("victim", "a diary");
  std::filesystem::create_symlink(folder.path("victim"), folder.path("picture.exr.stitching"));
  EXPECT_EQ(stitch("picture.exr"), 4);
  EXPECT_NE(err.find("picture.exr.stitching': it is a link; remove it"), std::string::npos) << err;
  std::filesystem::copy(folder.path("victim"), folder.path("other.exr.stitching"));
  EXPECT_EQ(stitch("other.exr"), 4);
  EXPECT_NE(err.find("rename or remove it"), std::string::npos) << err;
  EXPECT_EQ(folder.read("victim"), "a diary");
  EXPECT_EQ(folder.read("other.exr.stitching"), "a diary");
  EXPECT_FALSE(std::filesystem::exists(folder.path("picture.exr")));
}

TEST_F(StitchCommand, ViewsAreShared) {
  ASSERT_EQ(plan("--slits 6 --width 64"), 0) << err;
  const std::vector<std::string> job = {"render", "axis", "--samples", "64", "--skip-existing",
                                        "--rig",  rig,    "-o",        views};
  Ods first(job), second(job);
  EXPECT_EQ(first.finish(), 0) << first.err;
  EXPECT_EQ(second.finish(), 0) << second.err;
  for (int view = 1; view <= 24; view++) {
    const std::string name = fmt::format("/{:04}.exr\n", view);
    const bool by_first = first.out.find(name) != std::string::npos;
    EXPECT_NE(by_first, second.out.find(name) != std::string::npos) << view;
  }
  EXPECT_EQ(run("stitch " + rig + " " + views + " --list-missing"), 0) << err;
  EXPECT_EQ(out, "");
}

TEST_F(StitchCommand, FramesAreShared) {
  ASSERT_EQ(plan("--slits 6 --width 64"), 0) << err;
  for (const char* frame : {"1", "2", "3"}) {
    const std::string to = folder.path(std::string("views.") + frame + "/####.png");
    ASSERT_EQ(run("render axis -q --samples 1 --rig " + rig + " -o " + to), 0) << err;
  }
  folder.write(".shot.2.png.claim", "omnistereo claim\nhost render7\nboot none-of-ours\nprocess 812\nsince now\n");
  Ods sharing({"stitch", rig, folder.path("views.#/####.png"), "--frames", "1-3", "--skip-existing", "-o",
               folder.path("shot.#.png")});
  sharing.wait_for("waiting for frame 2, which is being made by process 812 on 'render7', since now");
  std::filesystem::copy(folder.path("shot.1.png"), folder.path("shot.2.png"));
  EXPECT_EQ(sharing.finish(), 0) << sharing.err;
  EXPECT_EQ(sharing.out, folder.path("shot.1.png") + "\n" + folder.path("shot.3.png") + "\n");
  EXPECT_EQ(run("stitch " + rig + " " + folder.path("views.1/####.png") + " -o " + folder.path("shot.2.png")), 4);
  EXPECT_NE(err.find("another ods is at work on '" + folder.path("shot.2.png") + "': process 812"), std::string::npos)
      << err;
}

// The command line asks for it, or the rig's file does.
TEST_F(StitchCommand, ATiltedHeadIsRefused) {
  ASSERT_EQ(run("render furnace --width 16 --samples 1 --eyes mono -q -o " + folder.path("map.png")), 0) << err;
  for (const char* slits : {"--slits 12", "--max-error 1"}) {
    EXPECT_EQ(run(std::string("rig --width 64 --nearest 1 -o ") + rig + " --head-tilt-map " + folder.path("map.png") +
                  " " + slits),
              2);
    EXPECT_NE(err.find("slits are level and cannot show a tilted head"), std::string::npos) << err;
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    EXPECT_FALSE(std::filesystem::exists(rig));
  }
  ASSERT_EQ(plan(), 0) << err;
  std::string text = folder.read("rig.json");
  const std::string level = "\"head_tilt_map\": null";
  ASSERT_NE(text.find(level), std::string::npos);
  text.replace(text.find(level), level.size(), R"("head_tilt_map": {"width": 1, "height": 1, "values": [1]})");
  folder.write("rig.json", text);
  EXPECT_EQ(stitch("y.exr"), 3);
  EXPECT_NE(err.find("slits are level and cannot show a tilted head"), std::string::npos) << err;
}

// From the scene when the rig is planned, or from the views' depth when they are put together.
TEST_F(StitchCommand, TheMergeFollowsDepth) {
  const auto worst = [&](const std::string& picture) {
    const int code = run("comfort " + picture + " --json");
    EXPECT_TRUE(code == 0 || code == 5) << err;
    const size_t at = out.find("\"vertical\": ");
    return at == std::string::npos ? -1.0 : std::atof(out.c_str() + at + 12);
  };
  const auto render_room = [&] { return run("render room -q --samples 1 --bounces 1 --rig " + rig + " -o " + views); };
  ASSERT_EQ(plan("--slits 24 --width 128 --depth ray"), 0) << err;
  ASSERT_EQ(render_room(), 0) << err;
  ASSERT_EQ(stitch("free.exr"), 0) << err;
  ASSERT_EQ(stitch("calm.exr", "--merge auto,20 --sidecar"), 0) << err;
  EXPECT_NE(err.find("merge by depth: full stereo up to "), std::string::npos) << err;
  EXPECT_GT(worst(folder.path("free.exr")), 25.0);
  EXPECT_LE(worst(folder.path("calm.exr")), 20.5);
  EXPECT_GE(worst(folder.path("calm.exr")), 12.0);
  EXPECT_EQ(ods::open_picture(folder.path("calm.exr")).camera.top.mode, ods::kMergeMap);
  EXPECT_FALSE(std::filesystem::exists(folder.path("calm.exr.merging.exr")));
  std::filesystem::remove_all(folder.path("views"));
  ASSERT_EQ(plan("--slits 24 --width 128 --pitches 6 --depth ray --scene room --merge auto,20"), 0) << err;
  EXPECT_NE(err.find("merge by depth: full stereo up to "), std::string::npos) << err;
  ASSERT_EQ(render_room(), 0) << err;
  ASSERT_EQ(stitch("planned.exr", "--sidecar"), 0) << err;
  EXPECT_LE(worst(folder.path("planned.exr")), 20.5);
  // Views without depth.
  EXPECT_EQ(plan("--slits 12 --width 64 --merge auto"), 2);
  EXPECT_NE(err.find("add --scene SCENE"), std::string::npos) << err;
  ASSERT_EQ(plan(), 0) << err;
  EXPECT_EQ(stitch("no.exr", "--merge auto"), 2);
  EXPECT_NE(err.find("ods rig --depth plane"), std::string::npos) << err;
  EXPECT_EQ(stitch("no.exr", "--merge cosine"), 2);
  EXPECT_EQ(stitch("no.####.exr", "--merge auto --frames 1-2"), 2);
  EXPECT_NE(err.find("ods convert --merge auto"), std::string::npos) << err;
}

TEST_F(StitchCommand, ExitCodesSayWhatWasWrong) {
  EXPECT_EQ(run("rig --slits 12 --width 66 --projection cube-3x2"), 2);
  EXPECT_NE(err.find("lat-long"), std::string::npos) << err;
  EXPECT_EQ(run("rig --width 64 --merge cosine,60,90 --max-error 0.01"), 2);
  EXPECT_EQ(run("stitch " + rig + " x.exr -o y.exr"), 3);
  folder.write("rig.json", "{\"omnistereo_slits\": 1}");
  EXPECT_EQ(stitch("y.exr"), 3);
  ASSERT_EQ(plan(), 0) << err;
  EXPECT_EQ(run("stitch " + rig + " x.exr -o y.exr"), 2);
  EXPECT_NE(err.find("####"), std::string::npos) << err;
  EXPECT_EQ(stitch("y.exr"), 3);  // no view is there
  EXPECT_EQ(run("render axis --rig " + rig + " -o " + views + " --width 100"), 2);
}

}  // namespace ods::cli_stitch_test
