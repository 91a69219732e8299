// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Inputs that are several files, and commands that share their reader.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "ods/picture/face_files.h"
#include "ods/picture/stored_picture.h"
#include "tests/support/cli_runner.h"
#include "tests/support/made_tiff.h"

namespace ods::convert_inputs_test {

class Inputs : public Cli {
 protected:
  // A stereo picture as a file for each eye.
  void make_pair(const std::string& left, const std::string& right) {
    ASSERT_EQ(run("render room -q --width 256 --samples 4 --threads 2 -o " + folder.path("%V.png")), 0) << err;
    std::filesystem::rename(folder.path("left.png"), folder.path(left));
    std::filesystem::rename(folder.path("right.png"), folder.path(right));
  }
  int convert(const std::string& from, const std::string& to, const std::string& words = "") {
    return run(fmt::format("convert {} -o {} {}", from, folder.path(to), words));
  }
  bool is_told(const std::string& text) const { return err.find(text) != std::string::npos; }
};

TEST_F(Inputs, OneFileOfAPairIsReadWithTheOther) {
  make_pair("trip_L.png", "trip_R.png");
  const std::string left = folder.path("trip_L.png"), right = folder.path("trip_R.png");
  ASSERT_EQ(convert(left + " " + right, "two_360_TB.png", "-q"), 0) << err;
  EXPECT_EQ(open_picture(folder.path("two_360_TB.png")).size.height, 128);
  ASSERT_EQ(convert(right + " " + left, "swapped_360_TB.png"), 0) << err;
  EXPECT_TRUE(is_told("by its name")) << err;
  ASSERT_EQ(convert(left, "one_360_TB.png"), 0) << err;
  EXPECT_TRUE(is_told("trip_R.png")) << err;
  EXPECT_EQ(folder.read("two_360_TB.png"), folder.read("swapped_360_TB.png"));
  EXPECT_EQ(folder.read("two_360_TB.png"), folder.read("one_360_TB.png"));
  ASSERT_EQ(convert(left, "alone_360.png", "--layout separate"), 0) << err;
  EXPECT_EQ(open_picture(folder.path("alone_360.png")).eyes.size(), 1u);
}

TEST_F(Inputs, EveryCommandReadsBoth) {
  make_pair("trip_L.png", "trip_R.png");
  const std::string left = folder.path("trip_L.png"), right = folder.path("trip_R.png");
  ASSERT_EQ(run("probe " + left), 0) << err;
  EXPECT_NE(out.find("separate, lat-long"), std::string::npos) << out;
  EXPECT_EQ(out.find("warning"), std::string::npos) << out;
  ASSERT_EQ(run("lint " + left + " " + right), 0) << out << err;
  EXPECT_NE(out.find("{L|R}"), std::string::npos) << out;
  EXPECT_NE(run("comfort " + left + " " + right), 3) << err;
  EXPECT_NE(out.find("by matching"), std::string::npos) << out;
  ASSERT_EQ(run("view " + left + " " + right + " --export " + folder.path("site")), 0) << err;
  EXPECT_TRUE(std::filesystem::exists(folder.path("site/item/0/left.jpg")));
  EXPECT_TRUE(std::filesystem::exists(folder.path("site/item/0/right.jpg")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("site/item/1")));
  std::filesystem::create_directory(folder.path("trip"));
  for (const std::string& eye : {left, right}) {
    std::filesystem::rename(eye, folder.path("trip/" + std::filesystem::path(eye).filename().string()));
  }
  ASSERT_EQ(run("view " + folder.path("trip") + " --export " + folder.path("whole")), 0) << err;
  EXPECT_TRUE(std::filesystem::exists(folder.path("whole/item/0/right.jpg")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("whole/item/1")));
}

TEST_F(Inputs, OfOtherKindsLeadToTheNextStep) {
  const std::string packet = "G@" + std::string(186, '\x11');
  const struct {
    const char* name;
    std::string bytes;
    const char* advice;
  } kTable[] = {
      {"00001.mts", std::string("\0\0\1\2", 4) + packet, "right eye of 3D cameras (MVC)"},
      {"00002.m2ts", packet, "-c copy FILE.mkv"},
      {"stream.m3u8", "#EXTM3U\n#EXT-X-VERSION:7\n", "'ffmpeg -i FILE -c copy FILE.mp4'"},
      {"depth.npz", std::string("PK\3\4\x14\0\0\0", 8), "ods takes each .npy as depth"},
  };
  for (const auto& row : kTable) {
    folder.write(row.name, row.bytes);
    for (const char* command : {"probe", "lint", "convert"}) {
      const bool converts = std::string(command) == "convert";
      EXPECT_EQ(
          run(fmt::format("{} {}{}", command, folder.path(row.name), converts ? " -o " + folder.path("x.jpg") : "")),
          3);
      EXPECT_TRUE(is_told(row.advice)) << command << " " << row.name << ": " << err;
      EXPECT_TRUE(is_told(row.name)) << err;
      EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    }
  }
}

TEST_F(Inputs, SixFacesAreOnePicture) {
  std::filesystem::create_directory(folder.path("sky"));
  ASSERT_EQ(run("render room -q --eyes mono --width 256 --samples 4 --threads 2 -o " + folder.path("w_360.png")), 0);
  // Our faces of up and down adjoin the one ahead, too.
  const char* const views[] = {"right", "left", "up", "down", "front", "back"};
  for (size_t i = 0; i < kFaceCount; i++) {
    ASSERT_EQ(
        run(fmt::format("render room -q --eyes mono --face {} --width 64 --height 64 --samples 4 --threads 2 -o {}",
                        views[i], folder.path(fmt::format("sky/{}.png", kFaceWordsTable[0].words[i])))),
        0)
        << err;
  }
  for (const std::string from : {"sky", "sky/px.png"}) {
    ASSERT_EQ(convert(folder.path(from), "world_360.png", "--to lat-long --width 256"), 0) << err;
    ASSERT_EQ(run("compare " + folder.path("world_360.png") + " " + folder.path("w_360.png") + " --min-psnr 22"), 0)
        << out;
  }
  std::filesystem::rename(folder.path("sky/px.png"), folder.path("sky/x.png"));
  std::filesystem::rename(folder.path("sky/nx.png"), folder.path("sky/px.png"));
  std::filesystem::rename(folder.path("sky/x.png"), folder.path("sky/nx.png"));
  EXPECT_EQ(convert(folder.path("sky"), "no.png"), 3);
  EXPECT_TRUE(is_told("do not continue")) << err;
}

TEST_F(Inputs, ACroppedTiffIsPlaced) {
  MadeTiff tiff{64, 32};
  tiff.ratios = {{282, 150.0}, {283, 150.0}, {286, 32.0 / 150.0}, {287, 16.0 / 150.0}};
  tiff.numbers = {{33300, 128}, {33301, 64}};
  folder.write("part.tif", tiff.bytes());
  ASSERT_EQ(convert(folder.path("part.tif"), "whole.png", "--to lat-long --width 128"), 0) << err;
  EXPECT_TRUE(is_told("75 %")) << err;
}

TEST_F(Inputs, WhatDoesNotBelongTogetherIsOneLine) {
  folder.write("a.png", "x");
  const std::string a = folder.path("a.png");
  EXPECT_EQ(convert(a + " " + a + " " + a, "b.png"), 2);
  EXPECT_EQ(convert(a + " " + folder.path(""), "b.png"), 2);
  EXPECT_EQ(convert("", "b.png"), 2);
  EXPECT_EQ(convert(a + " " + folder.path("absent.png"), "b.png"), 3);
  EXPECT_TRUE(is_told("a.png")) << err;
}

}  // namespace ods::convert_inputs_test
