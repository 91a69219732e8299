// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/layout.h"

#include <gtest/gtest.h>

#include <set>

#include "ods/kernel/camera/camera.h"

namespace ods {
namespace {

TEST(Layout, EveryLayoutHasItsOwnName) {
  std::set<std::string_view> names;
  for (Layout layout : kLayouts) names.insert(layout_name(layout));
  EXPECT_EQ(names.size(), std::size(kLayouts));
  EXPECT_FALSE(names.contains(""));
}

// Every row of the packed image, as eye and row of that eye, from left to right.
std::string rows(Layout layout, int eye_count) {
  const Extent eye{4, 2};
  std::string text;
  for (int y = 0; y < packed_size(layout, eye, eye_count).height; y++) {
    for (const EyeRow& part : packed_row(layout, eye, eye_count, y)) {
      text += std::to_string(part.index) + ":" + std::to_string(part.y) + " ";
    }
    text += "/ ";
  }
  return text;
}

TEST(Layout, LeftIsOnTopAndOnTheLeft) {
  EXPECT_EQ(rows(Layout::kTopBottom, 2), "0:0 / 0:1 / 1:0 / 1:1 / ");
  EXPECT_EQ(rows(Layout::kSideBySide, 2), "0:0 1:0 / 0:1 1:1 / ");
  for (Layout layout : kLayouts) EXPECT_EQ(rows(layout, 1), "0:0 / 0:1 / ");
}

TEST(Layout, PackedSizeFitsItsRows) {
  for (Layout layout : kLayouts) {
    for (int eye_count : {1, 2}) {
      const Extent size = packed_size(layout, {4, 2}, eye_count);
      EXPECT_EQ(size.width, 4 * static_cast<int>(packed_row(layout, {4, 2}, eye_count, 0).size()));
    }
  }
}

TEST(Layout, FileNamesOfEyes) {
  EXPECT_TRUE(names_eye("a.%V.png"));
  EXPECT_TRUE(names_eye("%v/a.png"));
  EXPECT_FALSE(names_eye("100%.png"));
  EXPECT_EQ(path_for_eye("%V/a.%v.%V.exr", kLeft), "left/a.l.left.exr");
  EXPECT_EQ(path_for_eye("%V/a.%v.%V.exr", kRight), "right/a.r.right.exr");
}

}  // namespace
}  // namespace ods
