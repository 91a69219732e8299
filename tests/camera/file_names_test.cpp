// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/file_names.h"

#include <gtest/gtest.h>

#include "ods/camera/layout.h"
#include "ods/kernel/camera/camera.h"

namespace ods {
namespace {

using Files = std::vector<std::string>;

TEST(FileNames, WordsForTheEyes) {
  EXPECT_EQ(eye_of_words("trip_L"), kLeft);
  EXPECT_EQ(eye_of_words("Right eye"), kRight);
  EXPECT_EQ(eye_of_words("cam1R"), kRight);
  EXPECT_EQ(eye_of_words(std::string("\5LINKS\0", 7)), kLeft);
  for (const char* name : {"", "leftover", "left and right", "VideoHandler"}) EXPECT_FALSE(eye_of_words(name)) << name;
}

TEST(FileNames, BracesWithTwoWordsStandForEyes) {
  EXPECT_TRUE(names_eye("trip_{L|R}.jpg"));
  EXPECT_FALSE(names_eye("trip_{L|R|x}.jpg"));
  EXPECT_FALSE(names_eye("trip_{L}.jpg"));
  EXPECT_FALSE(names_eye("{frame}_a|b.jpg"));
  EXPECT_EQ(path_for_eye("{a/left|b/right}_360.jpg", kLeft), "a/left_360.jpg");
  EXPECT_EQ(path_for_eye("{a/left|b/right}_360.jpg", kRight), "b/right_360.jpg");
}

TEST(FileNames, FilesOfAName) {
  EXPECT_EQ(files_of("a.png"), Files{"a.png"});
  EXPECT_EQ(files_of("%V.png"), (Files{"left.png", "right.png"}));
  EXPECT_EQ(files_of("s/{a|b|c|d|e|f}.png").size(), 6u);
  for (const char* twice : {"{l|x%V}.png", "{l|r}_{l|r}.png", "{l|r}/{%v|r}.png"}) {
    EXPECT_EQ(files_of(twice).size(), 2u) << twice;
  }
  const Files all = files_of("{l|r}_{a|b|c|d|e|f}.png");
  ASSERT_EQ(all.size(), 12u);
  EXPECT_EQ(all[1], "l_b.png");
  EXPECT_EQ(all[6], "r_a.png");
  EXPECT_TRUE(names_files("{a|b}.png") && names_files("{a|b|c|d|e|f}.png") && !names_files("{a|b|c}.png"));
}

TEST(FileNames, JoiningIsTheInverse) {
  const std::vector<Files> cases = {{"trip_L.jpg", "trip_R.jpg"},
                                    {"left/0001.png", "right/0001.png"},
                                    {"left.jpg", "right.jpg"},
                                    {"a/left/x.jpg", "b/right/y.jpg"},
                                    {"a.png", "ab.png"},
                                    {"one.jpg", "two.png"},
                                    {"px.png", "nx.png", "py.png", "ny.png", "pz.png", "nz.png"}};
  for (const Files& files : cases) {
    const std::optional<std::string> name = joined_name(files);
    ASSERT_TRUE(name) << files[0];
    EXPECT_EQ(files_of(*name), files) << *name;
  }
  EXPECT_EQ(joined_name({"left_a.png", "right_a.png"}), "{left|right}_a.png");
  EXPECT_EQ(joined_name({"{a|b}.png", "c.png"}), std::nullopt);
  EXPECT_EQ(joined_name({"l_{a|b|c|d|e|f}.png", "r_{a|b|c|d|e|f}.png"}), "{l|r}_{a|b|c|d|e|f}.png");
  const Files plain = {"trip_.jpg", "trip_R.jpg"};
  EXPECT_EQ(files_of(joined_name(plain).value()), plain) << "one of them adds nothing";
}

TEST(FileNames, TheRestOfAName) {
  EXPECT_EQ(without_words("trip_{L|R}_360.jpg"), "trip_360.jpg");
  EXPECT_EQ(without_words("trip_360_%V.jpg"), "trip_360.jpg");
  EXPECT_EQ(without_words("{left|right}/trip_180.jpg"), "trip_180.jpg");
  EXPECT_EQ(without_words("a/{left|right}_180.jpg"), "a/180.jpg");
}

}  // namespace
}  // namespace ods
