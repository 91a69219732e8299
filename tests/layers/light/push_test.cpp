// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/light/push.h"

#include <gtest/gtest.h>

#include "tests/support/statistics.h"

namespace ods::push_test {

// A texture of one channel, and who has and claims its texels.
struct Painted {
  Image image;
  std::vector<int> owners, claims;

  Painted(int width, int height)
      : image(width, height, 1), owners(image.pixels.size(), -1), claims(image.pixels.size(), -1) {}
  void put(int x, int y, int owner, float colour) {
    *image.at(x, y) = colour;
    owners[static_cast<size_t>(y * image.width + x)] = owner;
  }
  void claim_all(int owner) { std::fill(claims.begin(), claims.end(), owner); }
  float pushed(int rings, int x, int y) const {
    Image copy = image;
    push_outwards(copy, owners, claims, rings);
    return *copy.at(x, y);
  }
};

TEST(Push, ATexelGetsTheMeanOfThoseAroundIt) {
  Painted texture(5, 5);
  texture.put(1, 1, 7, 1.0f), texture.put(2, 1, 7, 3.0f), texture.put(3, 3, 7, 8.0f);
  texture.claim_all(7);
  EXPECT_FLOAT_EQ(texture.pushed(1, 2, 2), 4.0f);
  EXPECT_FLOAT_EQ(texture.pushed(1, 1, 2), 2.0f);
  EXPECT_FLOAT_EQ(texture.pushed(1, 0, 0), 1.0f);
  EXPECT_FLOAT_EQ(texture.pushed(1, 3, 1), 3.0f);
  EXPECT_FLOAT_EQ(texture.pushed(3, 3, 3), 8.0f);  // its own
}

// In a row with one colour at its end, ring by ring; the means of the second ring are of the first ring's colours.
TEST(Push, RingByRing) {
  Painted texture(6, 1);
  texture.put(0, 0, 2, 1.0f), texture.put(5, 0, 3, 9.0f);
  texture.claim_all(2);
  for (const int x : {1, 2, 3, 4}) EXPECT_EQ(texture.pushed(4, x, 0), 1.0f) << x;
  EXPECT_EQ(texture.pushed(1, 4, 0), 9.0f);  // not reached: the nearest colour of any
  EXPECT_EQ(texture.pushed(0, 2, 0), 1.0f);  // nearest
  EXPECT_EQ(texture.pushed(0, 3, 0), 9.0f);
}

TEST(Push, AClaimTakesItsOwnersColourOnly) {
  Painted texture(3, 3);
  texture.put(0, 1, 1, 10.0f), texture.put(2, 1, 2, 20.0f);
  texture.claims[1] = 1, texture.claims[4] = 2;
  EXPECT_EQ(texture.pushed(1, 1, 0), 10.0f);
  EXPECT_EQ(texture.pushed(1, 1, 1), 20.0f);
}

TEST(Push, NoTexelStaysBlackUnlessAllAre) {
  Painted texture(40, 30);
  EXPECT_EQ(texture.pushed(4, 3, 3), 0.0f);
  texture.put(17, 11, 0, 5.0f);
  Image image = texture.image;
  push_outwards(image, texture.owners, texture.claims, 4);
  for (const float colour : image.pixels) ASSERT_EQ(colour, 5.0f);
}

// Against a search over all colours.
TEST(Push, TheRestGetsTheNearestColour) {
  Dice dice(3);
  for (int round = 0; round < 20; round++) {
    Painted texture(23, 31);
    std::vector<vec2> places;
    for (int i = 0; i < 1 + 2 * round; i++) {
      const int x = static_cast<int>(dice.between(0.0f, 23.0f)), y = static_cast<int>(dice.between(0.0f, 31.0f));
      texture.put(x, y, 0, static_cast<float>(places.size()));
      places.emplace_back(x, y);
    }
    Image image = texture.image;
    push_outwards(image, texture.owners, texture.claims, 0);
    for (int y = 0; y < 31; y++) {
      for (int x = 0; x < 23; x++) {
        float nearest = 1e9f;
        for (const vec2 place : places) nearest = std::min(nearest, length(place - vec2(x, y)));
        const vec2 found = places[static_cast<size_t>(*image.at(x, y))];
        ASSERT_FLOAT_EQ(length(found - vec2(x, y)), nearest) << x << " " << y;
      }
    }
  }
}

TEST(Push, ColoursKeepTheirBitsAndChannelsAreApart) {
  Image image(2, 1, 3);
  for (size_t c = 0; c < 3; c++) image.pixels[c] = 0.1f * static_cast<float>(c + 1);
  const Image before = image;
  push_outwards(image, {4, -1}, {-1, 4}, 1);
  for (size_t c = 0; c < 3; c++) {
    EXPECT_EQ(image.pixels[c], before.pixels[c]);
    EXPECT_EQ(image.pixels[3 + c], before.pixels[c]);
  }
}

}  // namespace ods::push_test
