// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/marks.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ods {
namespace {

// Lines from near the top to near the bottom, on a ground of one value.
Image chart_on(float ground) {
  constexpr int kWidth = 400, kHeight = 200, kMargin = 8;
  Image chart(kWidth, kHeight, 1);
  std::fill(chart.pixels.begin(), chart.pixels.end(), ground);
  for (int y = kMargin; y < kHeight - kMargin; y++) {
    for (int x = 0; x < kWidth; x++) {
      if (x * x % 37 < 12) *chart.at(x, y) = 0.2f + 0.02f * static_cast<float>(x % 37);
    }
  }
  return chart;
}

// A sky and a ground without detail look like poles; the black ground of a chart, or a black border, does not.
TEST(Marks, ABlackRowIsNotAPole) {
  EXPECT_GT(marks_of(chart_on(0.5f)).poles, 0.9);
  EXPECT_LE(marks_of(chart_on(0.0f)).poles, 0.0);
  EXPECT_LE(marks_of(chart_on(0.03f)).poles, 0.0);
}

}  // namespace
}  // namespace ods
