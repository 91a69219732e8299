// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/checkerboard.h"

#include <gtest/gtest.h>

#include "tests/support/picture_rows.h"
#include "tests/support/saved_pictures.h"
#include "tests/support/temporary_folder.h"

namespace ods::checkerboard_test {

// Light is a ramp, so that the mean of four neighbours is what was left out; over the edge there is none to be had.
TEST(Checkerboard, KeepsHalfOfEachEyeAndFillsTheRest) {
  for (const char* extension : {"png", "tif", "hdr", "exr"}) {
    SCOPED_TRACE(extension);
    const TemporaryFolder folder;
    const std::string path = folder.path(std::string("a.") + extension);
    const FileFormat format = *format_of_path(path);
    save_picture(picture_rows({kLeft, kRight}, true, true), nullptr, options_for(Layout::kCheckerboard), path);
    EXPECT_EQ(read_info(path).width, kWidth);
    EXPECT_EQ(read_info(path).height, kHeight);
    const StoredPicture picture = open_picture(path, as(Layout::kCheckerboard));
    ASSERT_EQ(picture.eyes.size(), 2u);
    EXPECT_EQ(picture.size.width, kWidth);
    for (size_t i = 0; i < 2; i++) {
      const StoredEye& eye = picture.eyes[i];
      EXPECT_EQ(eye.eye, i == 0 ? kLeft : kRight);
      ASSERT_EQ(eye.layers.size(), format == FileFormat::kExr ? 3u : 1u);
      for (int y = 0; y < kHeight; y++) {
        for (int x = 1; x < kWidth; x++) {  // the first column is half transparent
          const bool is_edge = x < 2 || y == 0 || x == kWidth - 1 || y == kHeight - 1;
          const bool is_filled = is_left_out(static_cast<int>(i), x, y);
          if (is_edge && is_filled) continue;
          const float rounding = (is_filled ? 2.0f : 1.0f) * tolerance(format);  // of the neighbours, and its own
          ASSERT_NEAR(light_at(picture, eye, x, y, 1), light(eye.eye, x, y, 1), rounding) << x << ' ' << y;
        }
      }
    }
  }
}

TEST(Checkerboard, FillsLayersByTheirRulesAndColoursByTheirAlpha) {
  const TemporaryFolder folder;
  save_picture(picture_rows({kLeft, kRight}, true, true), nullptr, options_for(Layout::kCheckerboard),
               folder.path("a.exr"));
  const StoredPicture picture = open_picture(folder.path("a.exr"));
  EXPECT_EQ(picture.layout, Layout::kCheckerboard) << "the file says so";
  const StoredEye& right = picture.eyes[1];
  ASSERT_EQ(right.layers[2].channels, std::vector<std::string>{"Z"});
  EXPECT_EQ(value_at(right.layers[2], 4, 2, 0), 100.0f + light(kRight, 3, 2, 0)) << "of four the nearest, no mean";
  EXPECT_NEAR(value_at(right.layers[1], 4, 2, 2), light(kRight, 4, 2, 2) - 0.5f, 0.001f) << "the mean";
  EXPECT_NEAR(value_at(right.layers[0], 0, 0, 3), 0.75f, 1e-3f) << "between opaque and half transparent";
  save_picture(picture_rows({kLeft, kRight}, true, false), nullptr, options_for(Layout::kCheckerboard),
               folder.path("a.png"));
  const StoredPicture codes = open_picture(folder.path("a.png"), as(Layout::kCheckerboard));
  const float mean = (light(kRight, 1, 0, 1) + 0.5f * light(kRight, 0, 1, 1)) / 1.5f;
  EXPECT_NEAR(light_at(codes, codes.eyes[1], 0, 0, 1), mean, 0.005f) << "weighted by alpha";
}

}  // namespace ods::checkerboard_test
