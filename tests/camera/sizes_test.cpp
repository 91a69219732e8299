// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/sizes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <set>

#include "ods/camera/codec_level.h"

namespace ods {
namespace {

const NamedSize& row(std::string_view name) {
  for (const NamedSize& size : named_sizes()) {
    if (size.name == name) return size;
  }
  std::abort();
}

TEST(Sizes, EveryRowHasItsOwnName) {
  std::set<std::string_view> names;
  for (const NamedSize& size : named_sizes()) {
    EXPECT_TRUE(names.insert(size.name).second) << size.name;
    EXPECT_FALSE(size.title.empty() || size.source.empty()) << size.name;
  }
  EXPECT_FALSE(names.contains(""));
}

// "ODS TB High - 6480 x 6480" is tb-high-6480, in a file of that size.
TEST(Sizes, QuickresRowsAreThePages) {
  int rows = 0;
  for (const NamedSize& size : named_sizes()) {
    if (!size.title.starts_with("ODS ")) continue;
    rows++;
    std::string name(size.title.substr(4, size.title.find(" x ") - 4));
    name.erase(name.find(" - "), 2);
    for (char& c : name) c = c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    EXPECT_EQ(size.name, name);
    const Extent file = file_size(size);
    EXPECT_TRUE(size.title.ends_with(fmt::format(" - {} x {}", file.width, file.height))) << size.title;
    EXPECT_EQ(size.layout, size.name.starts_with("tb-") ? Layout::kTopBottom : Layout::kSideBySide);
    EXPECT_EQ(size.antialias, size.name.find("test") == std::string::npos ? "on, threshold 0.3" : "off");
  }
  EXPECT_EQ(rows, 7);
}

// The sizes in common use, and none larger than its codec: 8K is 7680x4320 pixels.
TEST(Sizes, HeadsetsAndSitesOfToday) {
  for (const char* name : {"quest-3", "quest-3-mono", "quest-3-vr180", "youtube-8k", "youtube-8k-mono"}) {
    const Extent file = file_size(row(name));
    EXPECT_LE(int64_t{file.width} * file.height, int64_t{7680} * 4320) << name;
    EXPECT_NE(smallest_level(Codec::kHevc, file, 30), "") << name;
  }
  EXPECT_EQ(row("vision-pro-vr180").layout, Layout::kSideBySide);
}

TEST(VideoLevel, EveryCodecHasItsOwnName) {
  std::set<std::string_view> names;
  for (Codec codec : kCodecs) names.insert(codec_name(codec));
  EXPECT_EQ(names.size(), std::size(kCodecs));
  EXPECT_FALSE(names.contains(""));
}

TEST(VideoLevel, KnownVideosHaveTheirLevels) {
  struct {
    Extent size;
    double fps;
    std::string_view h264, hevc, av1, vp9;
  } const videos[] = {
      {{1920, 1080}, 30, "4", "4", "4.0", "4"},
      {{3840, 2160}, 30, "5.1", "5", "5.0", "5"},
      {{3840, 2160}, 60, "5.2", "5.1", "5.1", "5.1"},
      {{3840, 3840}, 30, "6", "6", "6.0", "6"},
      {{4096, 4096}, 30, "6", "6", "6.0", "6"},
      {{5760, 5760}, 30, "6", "6", "6.0", "6"},
      {{5760, 5760}, 60, "6.1", "6.1", "6.1", "6.1"},
      {{2880, 2880}, 60, "5.2", "5.1", "5.1", "5.1"},
      {{7680, 7680}, 1, "", "", "", ""},
      {{8192, 8192}, 30, "", "", "", ""},
      {{7680, 4320}, 60, "6.1", "6.1", "6.1", "6.1"},
      {{16384, 2048}, 10, "6", "6", "6.0", "6"},
      {{2048, 16384}, 10, "6", "6", "", "6"},
      {{17008, 16}, 1, "", "", "", ""},
  };
  for (const auto& video : videos) {
    SCOPED_TRACE(fmt::format("{}x{} at {}", video.size.width, video.size.height, video.fps));
    EXPECT_EQ(smallest_level(Codec::kH264, video.size, video.fps), video.h264);
    EXPECT_EQ(smallest_level(Codec::kHevc, video.size, video.fps), video.hevc);
    EXPECT_EQ(smallest_level(Codec::kAv1, video.size, video.fps), video.av1);
    EXPECT_EQ(smallest_level(Codec::kVp9, video.size, video.fps), video.vp9);
  }
}

// The largest squares: the root of 35,651,584 pixels, in whole blocks.
TEST(VideoLevel, TheLimitIsWhereItsFactsPutIt) {
  for (Codec codec : kCodecs) {
    const int largest = codec == Codec::kAv1 || codec == Codec::kVp9 ? 5970 : 5968;
    EXPECT_NE(smallest_level(codec, {largest, largest}, 1), "") << codec_name(codec);
    EXPECT_EQ(smallest_level(codec, {largest + 1, largest + 1}, 1), "") << codec_name(codec);
  }
  EXPECT_EQ(smallest_level(Codec::kH264, {3072, 3072}, 26.0), "5.1");
  EXPECT_EQ(smallest_level(Codec::kH264, {3072, 3072}, 27.0), "5.2");
  EXPECT_EQ(smallest_level(Codec::kH264, {3073, 3072}, 1.0), "6");
}

TEST(VideoLevel, TheLimitRowHasALevelAndLargerOnesHaveNone) {
  for (Codec codec : kCodecs) {
    EXPECT_NE(smallest_level(codec, file_size(row("level-limit-5760")), 30), "");
    EXPECT_EQ(smallest_level(codec, file_size(row("tb-high-6480")), 30), "");
  }
}

}  // namespace
}  // namespace ods
