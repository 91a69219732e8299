// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/enum_array.h"

#include <gtest/gtest.h>

#include <numeric>

namespace ods {
namespace {

enum class Fruit { kApple, kPear, kPlum };

TEST(EnumArray, HasAValuePerMember) {
  EnumArray<Fruit, double> prices{};
  static_assert(prices.size() == 3);
  prices[Fruit::kPear] = 2.0;
  prices[Fruit::kPlum] += 0.5;
  EXPECT_EQ(prices[Fruit::kApple], 0.0);
  EXPECT_EQ(prices[Fruit::kPlum], 0.5);
  EXPECT_EQ(std::accumulate(prices.begin(), prices.end(), 0.0), 2.5);
}

}  // namespace
}  // namespace ods
