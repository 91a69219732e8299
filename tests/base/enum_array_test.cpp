// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/enum_array.h"

#include <gtest/gtest.h>

#include <numeric>

namespace ods {
namespace {

enum class Coin { kPenny, kDime, kCent };

TEST(EnumArray, HasAValuePerMember) {
  EnumArray<Coin, double> prices{};
  static_assert(prices.size() == 3);
  prices[Coin::kDime] = 2.0;
  prices[Coin::kCent] += 0.5;
  EXPECT_EQ(prices[Coin::kPenny], 0.0);
  EXPECT_EQ(prices[Coin::kCent], 0.5);
  EXPECT_EQ(std::accumulate(prices.begin(), prices.end(), 0.0), 2.5);
}

}  // namespace
}  // namespace ods
