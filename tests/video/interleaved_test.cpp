// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/interleaved.h"

#include <gtest/gtest.h>

#include <vector>

namespace ods {
namespace {

constexpr int kWidth = 8, kHeight = 4;

// A frame of 4:2:0 whose samples are 10 y + x; luma first, in rows of 16 bytes.
struct Made {
  std::vector<std::byte> bytes = std::vector<std::byte>(16 * 3 * kHeight);
  DecodedFrame frame;

  Made() {
    for (size_t i = 0; i < 3; i++) {
      std::byte* const plane = bytes.data() + 16 * i * kHeight;
      frame.planes.first[i] = plane, frame.planes.stride[i] = 16;
      for (int y = 0; y < kHeight; y++) {
        for (int x = 0; x < kWidth; x++) plane[16 * y + x] = static_cast<std::byte>(10 * y + x);
      }
    }
  }
};

int sample(const DecodedFrame& frame, size_t plane, size_t x, size_t y) {
  return static_cast<int>(frame.planes.first[plane][y * frame.planes.stride[plane] + x]);
}

TEST(TakeApart, EvenRowsAreAbove) {
  const Made made;
  const DecodedFrame apart = take_apart(made.frame, {kWidth, kHeight}, Views::kRows);
  const int rows[] = {0, 2, 1, 3};
  for (size_t y = 0; y < 4; y++) EXPECT_EQ(sample(apart, 0, 5, y), 10 * rows[y] + 5);
  EXPECT_EQ(sample(apart, 1, 3, 0), 3);
  EXPECT_EQ(sample(apart, 2, 3, 1), 13);
}

TEST(TakeApart, EvenColumnsAreOnTheLeft) {
  const Made made;
  const DecodedFrame apart = take_apart(made.frame, {kWidth, kHeight}, Views::kColumns);
  const int columns[] = {0, 2, 4, 6, 1, 3, 5, 7};
  for (size_t x = 0; x < 8; x++) EXPECT_EQ(sample(apart, 0, x, 3), 30 + columns[x]);
  const int chroma[] = {0, 2, 1, 3};
  for (size_t x = 0; x < 4; x++) EXPECT_EQ(sample(apart, 1, x, 1), 10 + chroma[x]);
}

TEST(TakeApart, KeepsAlphaAndSamplesOfTwoBytes) {
  Made made;
  made.frame.alpha = made.bytes.data(), made.frame.alpha_stride = 16;
  made.frame.planes.bits = 10;
  const DecodedFrame apart = take_apart(made.frame, {kWidth / 2, kHeight}, Views::kColumns);
  EXPECT_EQ(sample(apart, 0, 2, 1), 14);  // the low byte of the third sample
  EXPECT_EQ(static_cast<int>(apart.alpha[apart.alpha_stride + 2]), 14);
}

}  // namespace
}  // namespace ods
