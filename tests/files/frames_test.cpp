// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "ods/base/error.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

using Frames = std::vector<int>;

TEST(Frames, RangesAsFarmsWriteThem) {
  EXPECT_EQ(parse_frames("7"), (Frames{7}));
  EXPECT_EQ(parse_frames("1-5"), (Frames{1, 2, 3, 4, 5}));
  EXPECT_EQ(parse_frames("1..3"), (Frames{1, 2, 3}));
  EXPECT_EQ(parse_frames("1-10x4"), (Frames{1, 5, 9}));
  EXPECT_EQ(parse_frames("1-10:4"), (Frames{1, 5, 9}));
  EXPECT_EQ(parse_frames("1, 5,\t10-12"), (Frames{1, 5, 10, 11, 12}));
  EXPECT_EQ(parse_frames("-3--1"), (Frames{-3, -2, -1}));
  EXPECT_EQ(parse_frames("-1-1"), (Frames{-1, 0, 1}));
  EXPECT_EQ(parse_frames("3-1"), (Frames{3, 2, 1}));
  EXPECT_EQ(parse_frames("9-1x-4"), (Frames{9, 5, 1}));
  EXPECT_EQ(parse_frames("9-1x4"), (Frames{9, 5, 1}));
  EXPECT_EQ(parse_frames("0007"), (Frames{7}));
  EXPECT_EQ(parse_frames("5-5"), (Frames{5}));
  EXPECT_EQ(parse_frames("1-3,5,7-12:2"), (Frames{1, 2, 3, 5, 7, 9, 11}));
  EXPECT_EQ(parse_frames("[1-3]"), (Frames{1, 2, 3}));
  EXPECT_EQ(parse_frames("[ 1-2, 7 ]"), (Frames{1, 2, 7}));
  EXPECT_EQ(parse_frames("1-3,2-4,3"), (Frames{1, 2, 3, 4}));
  EXPECT_EQ(parse_frames("5-5x3"), (Frames{5}));
  EXPECT_EQ(parse_frames("-999999999-999999999x999999999"), (Frames{-999999999, 0, 999999999}));
}

TEST(Frames, InvalidRangesAreReported) {
  const std::pair<const char*, const char*> kCases[] = {
      {"", "a number is missing at the end"},
      {"1-", "a number is missing at the end"},
      {"1,", "a number is missing at the end"},
      {"a", "'a' is not a number"},
      {"1-b", "'b' is not a number"},
      {"1-10y3", "'y3' is not understood"},
      {"1-10x0", "the step is 0"},
      {"1-10x-2", "a step of -2 does not lead from 1 to 10"},
      {"1-2000000", "more than 1000000 frames"},
      {"1-600000,700000-1300000", "more than 1000000 frames"},
      {"1234567890", "a number has at most 9 digits"},
      {"1.5", "'.5' is not understood"},
      {"[1-5", "the bracket is not closed"},
      {"1-5]", "']' is not understood"},
      {"[1-5],7", "',7' is not understood"},
      {"[]", "']' is not a number"},
  };
  for (const auto& [text, why] : kCases) {
    try {
      parse_frames(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(std::string("'") + text + "'"), std::string::npos) << error.what();
    }
  }
}

TEST(Frames, TextIsShortAndComesBack) {
  EXPECT_EQ(frames_text({}), "");
  EXPECT_EQ(frames_text({4}), "4");
  EXPECT_EQ(frames_text({4, 5}), "4-5");
  EXPECT_EQ(frames_text({4, 6}), "4,6");
  EXPECT_EQ(frames_text({1, 2, 3, 4, 5, 6, 7, 9, 11, 13, 15}), "1-7,9-15x2");
  EXPECT_EQ(frames_text({1, 3, 4, 5}), "1,3-5");
  EXPECT_EQ(frames_text({-2, -1, 0}), "-2-0");
  EXPECT_EQ(frames_text({9, 7, 5}), "9-5x2");
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    Frames frames;
    for (int frame = -20; frame < 20; ++frame) {
      if (random() % 3 != 0) frames.push_back(frame);
    }
    if (round % 2 == 1) std::shuffle(frames.begin(), frames.end(), random);
    if (frames.empty()) continue;
    EXPECT_EQ(parse_frames(frames_text(frames)), frames) << frames_text(frames);
  }
}

TEST(Frames, GapsKnowTheStep) {
  EXPECT_EQ(gaps({}), Frames{});
  EXPECT_EQ(gaps({3}), Frames{});
  EXPECT_EQ(gaps({1, 2, 3, 5, 8}), (Frames{4, 6, 7}));
  EXPECT_EQ(gaps({1, 3, 5, 9}), (Frames{7}));
  EXPECT_EQ(gaps({10, 20}), Frames{});
  EXPECT_EQ(gaps({-2147483647, -2147483646, 2147483647}).size(), 1'000'000u);
}

TEST(Frames, NamesHaveAPlaceForTheNumber) {
  const std::pair<const char*, const char*> kCases[] = {
      {"shot.####.exr", "shot.0007.exr"},
      {"shot.#.exr", "shot.7.exr"},
      {"shot.@@.exr", "shot.07.exr"},
      {"shot.%04d.exr", "shot.0007.exr"},
      {"shot.%d.exr", "shot.7.exr"},
      {"shot.$F4.exr", "shot.0007.exr"},
      {"shot.$F.exr", "shot.7.exr"},
      {"shot{frame}.exr", "shot7.exr"},
      {"a#b/s.%03d.%V.exr", "a#b/s.007.%V.exr"},
      {"take#1.####.png", "take#1.0007.png"},
      {"%V_##.png", "%V_07.png"},
      {"%3d.png", "007.png"},
  };
  for (const auto& [pattern, name] : kCases) {
    const auto names = frame_names(pattern);
    ASSERT_TRUE(names) << pattern;
    EXPECT_EQ(names->path(7), name);
  }
  EXPECT_EQ(frame_names("####")->path(-7), "-007");
  EXPECT_EQ(frame_names("####")->path(12345), "12345");
  for (const char* none :
       {"shot.exr", "a####/shot.exr", "%V.exr", "%v_%x.png", "100%.png", "%100d.png", "$f.exr", ""}) {
    EXPECT_FALSE(frame_names(none)) << none;
  }
}

TEST(Frames, FilesOfAPatternAreFound) {
  const TemporaryFolder folder;
  for (const char* name : {"s.0010.exr", "s.0002.exr", "s.-003.exr", "s.12345.exr", "s.01.exr", "s.00011.exr",
                           "s.0003.png", "s..exr", "s.a.exr", "t.0005.exr", ".s.0004.exr.tmp"}) {
    folder.write(name, "");
  }
  EXPECT_EQ(frames_on_disk(*frame_names(folder.path("s.####.exr"))), (Frames{-3, 2, 10, 12345}));
  EXPECT_EQ(frames_on_disk(*frame_names(folder.path("x.####.exr"))), Frames{});
  EXPECT_THROW(frames_on_disk(*frame_names(folder.path("none/x.####.exr"))), Error);
}

}  // namespace
}  // namespace ods
