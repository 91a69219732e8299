// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/resample.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <random>

#include "ods/image/format/sample_type.h"
#include "tests/support/stored_pictures.h"

namespace ods {
namespace {

uint16_t half_of(float value) {
  uint16_t half = 0;
  floats_to_halves({&value, 1}, &half);
  return half;
}

float float_of(int half) {
  return glm::unpackHalf1x16(static_cast<uint16_t>(half));
}

TEST(Halves, EveryOneComesBackAndTiesGoToTheEven) {
  const int kInfinity = 0x7c00;
  for (const int sign : {0, 0x8000}) {
    for (int half = 0; half < kInfinity; half++) {
      ASSERT_EQ(half_of(float_of(half | sign)), half | sign);
      if (half + 1 == kInfinity) continue;
      const float value = float_of(half | sign), next = float_of((half + 1) | sign), tie = 0.5f * (value + next);
      ASSERT_EQ(half_of(tie), (half + half % 2) | sign);
      ASSERT_EQ(half_of(std::nextafter(tie, value)), half | sign);
      ASSERT_EQ(half_of(std::nextafter(tie, next)), (half + 1) | sign);
    }
  }
}

TEST(Halves, NoneIsNanOrInfinity) {
  for (const float large : {65505.0f, 65520.0f, 65536.0f, 1e30f, INFINITY}) {
    EXPECT_EQ(float_of(half_of(large)), 65504.0f);
    EXPECT_EQ(float_of(half_of(-large)), -65504.0f);
  }
  EXPECT_EQ(float_of(half_of(NAN)), 0.0f);
  EXPECT_EQ(float_of(half_of(-NAN)), 0.0f);
  EXPECT_EQ(float_of(half_of(1e-40f)), 0.0f);
}

TEST(Halves, LieBesideFloats) {
  const std::vector<SampleType> channels{SampleType::kHalf, SampleType::kFloat, SampleType::kHalf};
  const std::vector<float> pixels{1.0f, 1e6f, -2.0f, 0.5f, 1e-30f, 65504.0f};
  std::vector<std::byte> packed(2 * 8);
  pack_floats(channels, pixels, packed.data());
  for (size_t i = 0; i < pixels.size(); i++) {
    const size_t at[] = {0, 2, 6, 8, 10, 14};
    EXPECT_EQ(sample_value(channels[i % 3], &packed[at[i]]), pixels[i]);
  }
}

// Filters for pixels of this size along the picture's columns and rows, turned by an angle.
Footprint footprint_of(float across, float down, float turn) {
  const float c = std::cos(turn), s = std::sin(turn);
  return {vec2(c, -s) * across, vec2(s, c) * down};
}

TEST(Filter, PointsHaveTheVarianceOfTheirTent) {
  std::vector<FilterPoint> points;
  for (const float size : {1.02f, 1.05f, 1.3f, 1.9f, 2.0f, 3.7f, 8.0f, 20.0f}) {
    filter_points(footprint_of(size, 0.7f, 0.0f), points);
    double sum = 0.0, mean = 0.0, squares = 0.0;
    for (const FilterPoint& point : points) {
      const double x = point.texels.x, weight = point.weight;
      sum += weight, mean += weight * x, squares += weight * x * x;
      EXPECT_NEAR(point.texels.y, 0.0f, 1e-6f);
      EXPECT_GT(weight, 0.0);
    }
    EXPECT_NEAR(sum, 1.0, 1e-5);
    EXPECT_NEAR(mean, 0.0, 1e-5);
    EXPECT_NEAR(squares, (size * size - 1.0) / 6.0, 1e-4 * size * size) << size;
  }
}

// Layers of all kinds of numbers, of up to seven channels.
MadePicture noisy_picture() {
  std::mt19937 engine(7);
  const auto codes = [&](int count) {
    return [&engine, count](int, vec2, float* out) {
      for (int c = 0; c < count; c++) out[c] = static_cast<float>(engine() >> 24);
    };
  };
  StereoCamera camera;
  MadePicture made = make_picture(camera, {64, 32}, {kMono});
  add_layer<uint8_t>(made, {"R", "G", "B", "A"}, LayerRule::kLight, SampleType::kUint8, codes(4));
  add_layer<uint16_t>(made, {"a", "b", "c", "d", "e", "f", "g"}, LayerRule::kMean, SampleType::kHalf, codes(7));
  add_layer<float>(made, {"h"}, LayerRule::kMean, SampleType::kFloat, codes(1));
  add_layer<uint16_t>(made, {"i", "j"}, LayerRule::kMean, SampleType::kUint16, codes(2));
  return made;
}

// A row of pixels, which run in any direction: those whose filters share texels and those that are far apart.
TEST(Filter, PixelsOfARowAreWhatTheyAreAlone) {
  const MadePicture made = noisy_picture();
  const Source source = make_source(made.picture);
  const Resampler resampler(source);
  const Cell cell{0, 0, 64, 32};
  ASSERT_EQ(resampler.channels(), 14);
  for (const vec2 step : {vec2(1.0f, 0.1f), vec2(0.4f, 0.0f), vec2(0.9f, 0.5f), vec2(0.1f, -0.6f), vec2(-2.3f, 0.7f)}) {
    const vec2 start = vec2(32.3f, 16.1f) - 10.0f * step;
    std::vector<TexelFilter> filters(20);
    for (size_t i = 0; i < 20; i++) {
      const auto tents = texel_tents({vec2(length(step), 0.0f), vec2(0.0f, 1.7f)});
      ASSERT_TRUE(tents);
      const vec2 place = start + static_cast<float>(i) * step;
      texel_filters(*tents, {&place, 1}, &filters[i]);
      ASSERT_TRUE(resampler.has_all({&filters[i], 1}, cell));
    }
    std::vector<float> row(20 * 14), alone(14);
    resampler.fill(0, filters, row.data());
    for (size_t i = 0; i < 20; i++) {
      resampler.fill(0, {&filters[i], 1}, alone.data());
      for (size_t c = 0; c < 14; c++) EXPECT_EQ(row[i * 14 + c], alone[c]) << i << " " << c;
    }
  }
}

// Noise, where the cubic often leaves the range of a row, and the rows beside it decide how far it may go.
TEST(Filter, PlacesOnARowOfTexelsAreWhatAllRowsGive) {
  const MadePicture made = noisy_picture();
  const Source source = make_source(made.picture);
  const Resampler resampler(source);
  std::vector<vec2> places;
  std::vector<TexelFilter> filters(100);
  for (size_t i = 0; i < filters.size(); i++) {
    places.emplace_back(10.0f + 0.37f * static_cast<float>(i), 9.5f);
    texel_filters({}, {&places[i], 1}, &filters[i]);
  }
  std::vector<float> row(filters.size() * 14);
  resampler.fill(0, filters, row.data());
  for (size_t i = 0; i < filters.size(); i++) {
    std::vector<float> all(14);
    resampler.add({0, places[i], true}, {0, 0, 64, 32}, 1.0f, all.data());
    for (size_t c = 0; c < 14; c++) EXPECT_EQ(row[i * 14 + c], all[c]) << i << " " << c;
  }
}

// Each point of a pixel's filter for itself, and all at once. On a ramp, in which nothing is cut.
TEST(Filter, ColumnsAndRowsAreThePointsTogether) {
  MadePicture made = make_picture(StereoCamera(), {64, 32}, {kMono});
  add_layer<float>(made, {"R", "G", "B"}, LayerRule::kLight, SampleType::kFloat,
                   [](int, vec2 uv, float* out) { out[0] = uv.x, out[1] = uv.y, out[2] = 3.0f * uv.x - uv.y; });
  const Source source = make_source(made.picture);
  const Resampler resampler(source);
  const Cell cell{0, 0, 64, 32};
  std::vector<FilterPoint> points;
  for (const float size : {0.5f, 1.005f, 1.05f, 1.5f, 2.6f, 5.0f}) {
    for (const float turn : {0.0f, 0.6f}) {
      const Footprint footprint = footprint_of(size, 1.0f, turn);
      const vec2 at(30.3f, 15.8f);
      TexelFilter filter;
      const bool leans = turn != 0.0f && size > 1.1f;
      const auto tents = texel_tents(footprint);
      ASSERT_EQ(tents.has_value(), !leans) << size << " " << turn;
      if (leans) continue;
      texel_filters(*tents, {&at, 1}, &filter);
      float together[3], apart[3] = {};
      resampler.fill(0, {&filter, 1}, together);
      filter_points(footprint, points);
      for (const FilterPoint& point : points) {
        resampler.add({0, at + point.texels, true}, cell, point.weight, apart);
      }
      for (int c = 0; c < 3; c++) EXPECT_NEAR(together[c], apart[c], 1e-5f) << size << " " << turn;
    }
  }
}

}  // namespace
}  // namespace ods
