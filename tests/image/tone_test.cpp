// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/tone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace ods {
namespace {

// The specification in double precision, step by step as it is published, as a twin to compare with.
std::array<double, 3> neutral_twin(std::array<double, 3> c) {
  const double fresnel = 0.04, start = 0.8 - fresnel, desaturation = 0.15;
  const double x = std::min({c[0], c[1], c[2]});
  const double offset = x < 0.08 ? x - 6.25 * x * x : fresnel;
  for (double& v : c) v -= offset;
  const double peak = std::max({c[0], c[1], c[2]});
  if (peak < start) return c;
  const double d = 1.0 - start;
  const double compressed = 1.0 - d * d / (peak + d - start);
  const double g = 1.0 - 1.0 / (desaturation * (peak - compressed) + 1.0);
  for (double& v : c) v = v * compressed / peak * (1.0 - g) + compressed * g;
  return c;
}

TEST(Tone, NeutralIsTheSpecification) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-12.0f, 12.0f);
  for (int i = 0; i < 20000; i++) {
    const vec3 light(std::exp2(exponent(random)), std::exp2(exponent(random)), std::exp2(exponent(random)));
    const vec3 shown = tone_map(light, 0.0f, ToneCurve::kNeutral);
    const auto twin = neutral_twin({light.x, light.y, light.z});
    for (int c = 0; c < 3; c++) ASSERT_NEAR(shown[c], twin[static_cast<size_t>(c)], 2e-6) << light[c];
  }
}

TEST(Tone, NeutralGivesABaseColorBack) {
  // Light from a white surround on a rough dielectric: its base colour and 4 % on top.
  const vec3 shown = tone_map(vec3(0.2f, 0.5f, 0.7f) + 0.04f, 0.0f, ToneCurve::kNeutral);
  EXPECT_NEAR(shown.x, 0.2f, 1e-6f);
  EXPECT_NEAR(shown.y, 0.5f, 1e-6f);
  EXPECT_NEAR(shown.z, 0.7f, 1e-6f);
}

TEST(Tone, NeutralIsContinuousAndRises) {
  float before = 0.0f;
  for (float light = 0.0f; light < 4.0f; light += 0.001f) {
    const float now = tone_map(vec3(light), 0.0f, ToneCurve::kNeutral).x;
    EXPECT_GE(now, before);
    EXPECT_LT(now - before, 0.0015f);
    before = now;
  }
}

TEST(Tone, LinearOnlyCuts) {
  EXPECT_EQ(tone_map(vec3(0.0f, 0.25f, 1.5f), 0.0f, ToneCurve::kLinear), vec3(0.0f, 0.25f, 1.0f));
}

TEST(Tone, ExposureIsInStops) {
  EXPECT_EQ(tone_map(vec3(0.0625f, 0.25f, 0.5f), 1.0f, ToneCurve::kLinear), vec3(0.125f, 0.5f, 1.0f));
  EXPECT_EQ(tone_map(vec3(0.0625f, 0.25f, 0.5f), -2.0f, ToneCurve::kLinear), vec3(0.015625f, 0.0625f, 0.125f));
}

TEST(Tone, EveryNumberIsShown) {
  const float huge = std::numeric_limits<float>::max(), inf = std::numeric_limits<float>::infinity();
  const float odd[] = {NAN, -NAN, inf, -inf, huge, -huge, -1.0f, -0.0f, 1e-45f, 0.0f, 1.0f};
  for (ToneCurve curve : kToneCurves) {
    for (float exposure : {0.0f, 200.0f, -200.0f, inf, -inf}) {
      for (float r : odd) {
        for (float g : odd) {
          const vec3 shown = tone_map(vec3(r, g, 0.5f), exposure, curve);
          for (int c = 0; c < 3; c++) ASSERT_TRUE(shown[c] >= 0.0f && shown[c] <= 1.0f) << r << " " << g;
        }
      }
    }
    EXPECT_EQ(tone_map(vec3(NAN, -1.0f, 0.0f), 0.0f, curve), vec3(0.0f));
    EXPECT_EQ(tone_map(vec3(inf), 0.0f, curve), vec3(1.0f));
  }
}

TEST(Tone, EveryCurveHasItsOwnName) {
  std::set<std::string_view> names;
  for (ToneCurve curve : kToneCurves) names.insert(tone_curve_name(curve));
  EXPECT_EQ(names.size(), std::size(kToneCurves));
  EXPECT_FALSE(names.contains(""));
}

TEST(Srgb, IsTheStandardAndItsInverse) {
  for (int code = 0; code <= 65535; code++) {
    const double encoded = code / 65535.0;
    const double linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    ASSERT_NEAR(srgb_decode(static_cast<float>(encoded)), linear, 5e-7);
    ASSERT_NEAR(srgb_encode(static_cast<float>(linear)), encoded, 1e-6);
  }
  EXPECT_NEAR(srgb_encode(0.18f), 0.46135613f, 1e-6f);
  EXPECT_EQ(srgb_encode(0.0f), 0.0f);
  EXPECT_NEAR(srgb_encode(1.0f), 1.0f, 1e-6f);
}

}  // namespace
}  // namespace ods
