// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/names.h"

#include <gtest/gtest.h>

namespace ods {
namespace {

enum class Fruit { kApple, kPear, kPlum };

constexpr NameRow<Fruit> kWhole[] = {{Fruit::kPlum, "plum"}, {Fruit::kApple, "apple"}, {Fruit::kPear, "pear"}};
constexpr NameRow<Fruit> kNoPlum[] = {{Fruit::kApple, "apple"}, {Fruit::kPear, "pear"}};
constexpr NameRow<Fruit> kNoPear[] = {{Fruit::kApple, "apple"}, {Fruit::kPlum, "plum"}};
constexpr NameRow<Fruit> kTwice[] = {
    {Fruit::kApple, "apple"}, {Fruit::kPear, "pear"}, {Fruit::kPlum, "plum"}, {Fruit::kPlum, "damson"}};
constexpr NameRow<Fruit> kOneName[] = {{Fruit::kApple, "apple"}, {Fruit::kPear, "apple"}, {Fruit::kPlum, "plum"}};
constexpr NameRow<Fruit> kNameless[] = {{Fruit::kApple, "apple"}, {Fruit::kPear, ""}, {Fruit::kPlum, "plum"}};
constexpr NameRow<int> kNumbers[] = {{1, "one"}, {0, "none"}};

static_assert(enumerator_count<Fruit>() == 3);
static_assert(has_every_member(kWhole));
static_assert(has_each_of(kNumbers, 2));

TEST(Names, AMemberThatIsLeftOutIsNoticed) {
  EXPECT_FALSE(has_every_member(kNoPlum)) << "the last";
  EXPECT_FALSE(has_every_member(kNoPear)) << "one between";
  EXPECT_FALSE(has_every_member(kTwice));
  EXPECT_FALSE(has_every_member(kOneName));
  EXPECT_FALSE(has_every_member(kNameless));
  EXPECT_FALSE(has_each_of(kNumbers, 3));
  EXPECT_FALSE(has_each_of(kNumbers, 1));
}

TEST(Names, ATableGivesNameLookUpAndList) {
  EXPECT_EQ(name_in(kWhole, Fruit::kPear), "pear");
  EXPECT_EQ(name_in(kNoPear, Fruit::kPear), "");
  EXPECT_EQ(find_in(kWhole, "plum"), Fruit::kPlum);
  EXPECT_EQ(find_in(kWhole, "cherry"), std::nullopt);
  EXPECT_EQ(find_in(kWhole, ""), std::nullopt);
  EXPECT_EQ(members_of(kWhole), (std::array{Fruit::kPlum, Fruit::kApple, Fruit::kPear}));
  EXPECT_EQ(names_of(kWhole), (std::vector<std::string>{"plum", "apple", "pear"}));
  EXPECT_EQ(row_in(kNumbers, 0).name, "none");
}

}  // namespace
}  // namespace ods
