// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/compose/testcard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ods/image/tone.h"
#include "ods/kernel/camera/project.h"

namespace ods {
namespace {

Image draw(const Testcard& card, int eye) {
  Image image(card.eye.width, card.eye.height, 3);
  for (int y = 0; y < image.height; y++) {
    fill_testcard_row(card, eye, y, {image.at(0, y), static_cast<size_t>(image.width) * 3});
  }
  return image;
}

vec3 pixel_at(const Image& image, vec2 uv) {
  const int x = std::clamp(static_cast<int>(uv.x * static_cast<float>(image.width)), 0, image.width - 1);
  const int y = std::clamp(static_cast<int>(uv.y * static_cast<float>(image.height)), 0, image.height - 1);
  return {image.at(x, y)[0], image.at(x, y)[1], image.at(x, y)[2]};
}

// Returns whether a colour belongs to a plate, its letters or its border, and not to the sky or the earth.
bool is_plate(vec3 color) {
  const float maximum = std::max({color.x, color.y, color.z}), minimum = std::min({color.x, color.y, color.z});
  return maximum < 0.02f || maximum > 0.3f || maximum - minimum > 0.1f;
}

TEST(Testcard, KnowsHowHighItsLettersAre) {
  const int width = 4096;
  float capital = 1.0f;  // tangents: of the smallest letters
  for (const Card& card : make_testcard(StereoCamera(), {width, width / 2}, {"A LINE"}).cards) {
    if (card.strokes.empty()) continue;
    float low = 1.0f, high = -1.0f;
    for (const Stroke& stroke : card.strokes) {
      low = std::min({low, stroke.from.y, stroke.to.y}), high = std::max({high, stroke.from.y, stroke.to.y});
    }
    if (high > low) capital = std::min(capital, high - low);
  }
  const double pixels = static_cast<double>(capital) * width / (2.0 * std::numbers::pi);
  EXPECT_NEAR(letter_height({}, width), pixels, 0.15 * pixels);
  EXPECT_GT(letter_height({}, 1536), kLegible);
  EXPECT_LT(letter_height({}, 1024), kLegible);
}

TEST(Testcard, HoldsLightInEveryProjection) {
  for (const NamedProjection& named : named_projections()) {
    StereoCamera stereo;
    stereo.projection = named.setting;
    const int width = 120;
    const Testcard card = make_testcard(stereo, {width, natural_height(named.setting, width)}, {"A LINE"});
    const Image image = draw(card, kRight);
    float minimum = 1.0f, maximum = 0.0f;
    for (float value : image.pixels) {
      ASSERT_TRUE(value >= 0.0f && value <= 1.0f) << named.name;
      minimum = std::min(minimum, value), maximum = std::max(maximum, value);
    }
    EXPECT_GT(maximum - minimum, 0.3f) << named.name;
  }
}

TEST(Testcard, EachEyeReadsItsOwnNameAlone) {
  const Testcard card = make_testcard({}, {1024, 512}, {});
  const Image left = draw(card, kLeft), right = draw(card, kRight);
  for (float heading : {0.0f, 90.0f, -90.0f}) {
    // Strokes that are brighter than the plate, inside the borders of the upper and the lower line.
    const auto letters = [&](const Image& image, float elevation) {
      int count = 0;
      for (float x = -10.0f; x < 10.0f; x += 0.3f) {
        for (float y = -1.2f; y < 1.2f; y += 0.3f) {
          const vec3 color = pixel_at(image, {0.5f + (heading + x) / 360.0f, 0.5f - (elevation + y) / 180.0f});
          count += std::max(color.x, color.z) > 0.2f;
        }
      }
      return count;
    };
    EXPECT_GT(letters(left, 13.4f), 50);
    EXPECT_EQ(letters(right, 13.4f), 0);
    EXPECT_EQ(letters(left, 8.6f), 0);
    EXPECT_GT(letters(right, 8.6f), 50);
  }
}

// Each plate lies in each eye where the camera's inverse puts its corners.
TEST(Testcard, PlatesStandAtTheirDistance) {
  StereoCamera stereo;
  stereo.yaw = 20.0f;
  stereo.top.mode = stereo.bottom.mode = kMergeCosine;
  const Testcard testcard = make_testcard(stereo, {2048, 1024}, {});
  int plates = 0;
  for (int eye : {kLeft, kRight}) {
    const Image image = draw(testcard, eye);
    for (const Card& card : testcard.cards) {
      if (card.inverse_depth == 0.0f || card.inverse_depth == 2.5f)
        continue;  // the plate at 0.4 m covers its neighbour
      const auto color_at = [&](float x, float y) {
        const vec3 p = card.middle + card.right * (x * card.half.x) + card.up * (y * card.half.y);
        const ImagePosition found = project_point(testcard.camera, eye, p / card.inverse_depth);
        EXPECT_TRUE(found.seen);
        return pixel_at(image, found.uv);
      };
      const bool free = card.inverse_depth < 1.0f;  // of neighbours that stand nearer
      int outside = 0;
      for (float place : {-0.8f, -0.4f, 0.0f, 0.4f, 0.8f}) {  // a line of the grid may stand behind one of them
        EXPECT_TRUE(is_plate(color_at(place, 0.93f))) << 1.0f / card.inverse_depth;
        outside += !is_plate(color_at(place, 1.08f));
      }
      EXPECT_GE(outside, 4) << 1.0f / card.inverse_depth;
      for (float side : {-1.0f, 1.0f}) {
        EXPECT_TRUE(is_plate(color_at(0.93f * side, 0.0f))) << 1.0f / card.inverse_depth;
        EXPECT_FALSE(free && is_plate(color_at(1.06f * side, 0.5f))) << 1.0f / card.inverse_depth;
      }
      plates++;
    }
  }
  EXPECT_EQ(plates, 2 * (4 * 7 + 2 * 3));
}

TEST(Testcard, GreysAreTheCodesTheyShow) {
  const Image image = draw(make_testcard({}, {2048, 1024}, {}), kMono);
  for (int step = 0; step <= 10; step++) {
    const float x = std::tan(glm::radians(18.0f)) * (static_cast<float>(step) - 5.0f + 0.35f) / 5.5f;
    // On the card, 19 degrees up: the tangent plane's point to heading and elevation.
    const vec3 p = vec3(x, std::sin(glm::radians(19.0f)), -std::cos(glm::radians(19.0f)));
    const vec3 color = pixel_at(image, direction_to_lat_long(p));
    EXPECT_EQ(std::lround(255.0f * srgb_encode(color.y)), std::lround(25.5 * step)) << step;
  }
}

TEST(Testcard, FinestBarsAreSinglePixels) {
  const Testcard testcard = make_testcard({}, {2048, 1024}, {});
  const Image image = draw(testcard, kLeft);
  const Card* finest = nullptr;
  for (const Card& card : testcard.cards) {
    if (card.pixels == 1 && card.middle.z < -0.7f) finest = &card;
  }
  ASSERT_NE(finest, nullptr);
  const vec2 uv = direction_to_lat_long(finest->middle + finest->up * (0.5f * finest->half.y));
  const int x = static_cast<int>(uv.x * 2048.0f), y = static_cast<int>(uv.y * 1024.0f);
  for (int i = 0; i < 8; i++) EXPECT_EQ(*image.at(x + i, y), (x + i) % 2 == 0 ? 1.0f : 0.0f);
}

}  // namespace
}  // namespace ods
