// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/metadata/name_words.h"

#include <gtest/gtest.h>

#include "ods/picture/metadata/stereo_format.h"

namespace ods {
namespace {

struct Case {
  const char* name;
  std::optional<Layout> layout;
  const char* projection;  // "" for none
  float fov = 0.0f;        // of a fisheye
};

TEST(NameWords, AreThoseOfPlayers) {
  constexpr auto kBeside = Layout::kSideBySide, kStacked = Layout::kTopBottom;
  for (const auto& [name, layout, projection, fov] : {
           Case{"a_180_180x180_3dh_LR.mp4", kBeside, "vr180"},
           {"a_180x180_3dh.mp4", kBeside, "vr180"},
           {"a_360_3dv.mp4", kStacked, "lat-long"},
           {"a_180_LR_8k.mp4", kBeside, "vr180"},
           {"a_180_LR_alpha.mp4", kBeside, "vr180"},
           {"a_360_TB_injected.mp4", kStacked, "lat-long"},
           {"a_360_TB_2160p_60fps_x265.mp4", kStacked, "lat-long"},
           {"a-180-LR.mp4", kBeside, "vr180"},
           {"a.180.LR.mp4", kBeside, "vr180"},
           {"a 360 tab.mp4", kStacked, "lat-long"},
           {"a_MKX200_LR.mp4", kBeside, "fisheye", 200.0f},
           {"a_MKX220_LR.mp4", kBeside, "fisheye", 220.0f},
           {"a_VRCA220_LR.mp4", kBeside, "fisheye", 220.0f},
           {"a_RF52_LR.mp4", kBeside, "fisheye", 190.0f},
           {"a_LR_FISHEYE190.mp4", kBeside, "fisheye", 190.0f},
           {"a_F180_SBS.mp4", kBeside, "fisheye", 180.0f},
           {"a_360tb.mp4", kStacked, "lat-long"},
           {"a-360OU.mp4", kStacked, "lat-long"},
           {"a.360tab.mp4", kStacked, "lat-long"},
           {"a 180SBS.mp4", kBeside, "vr180"},
           {"a_180lr_8k.mp4", kBeside, "vr180"},
           {"a (180 LR).mp4", kBeside, "vr180"},
           {"a [360 TB].mp4", kStacked, "lat-long"},
           {"a-VR180-LR.mp4", kBeside, "vr180"},
           {"a-EAC-TB.mp4", kStacked, "eac"},
           {"a_180_LR_final.mp4", kBeside, "vr180"},
           {"a_180x.mp4", std::nullopt, ""},
           {"a_top-bottom.mp4", kStacked, ""},
           {"calf-left-right.jpg", kBeside, ""},
           {"a-top-bottom_360.jpg", kStacked, "lat-long"},
           {"a_cube-3x2.png", std::nullopt, "cube-3x2"},
           {"shot_LR.180.png", kBeside, ""},  // a frame
           {"a-dome.jpg", std::nullopt, ""},  // a building
           {"rainy_day_8k.mp4", std::nullopt, ""},
           {"a_LR_tour.mp4", std::nullopt, ""},
       }) {
    const NameWords words = read_name(name);
    EXPECT_EQ(words.layout, layout) << name;
    EXPECT_EQ(words.projection ? words.projection->name : "", projection) << name;
    if (fov > 0.0f && words.projection) {
      EXPECT_EQ(words.projection->setting.fov, fov) << name;
    }
  }
}

TEST(NameWords, ThatContradictEachOtherEndTheReading) {
  EXPECT_EQ(read_name("a_360_3dv_LR.mp4").layout, Layout::kSideBySide);
  EXPECT_EQ(read_name("a_360_3dv_LR.mp4").projection, nullptr);
}

TEST(NameWords, HaveOneMeaningEach) {
  for (const NameWordRow& row : name_words()) {
    EXPECT_NE(row.layout.has_value(), row.projection.has_value()) << row.word;
    EXPECT_FALSE(is_neutral_token(row.word) && !row.projection) << row.word;
  }
}

}  // namespace
}  // namespace ods
