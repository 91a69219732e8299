// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Views of a sphere of random waves, of which the right one is misaligned by known angles.
#include "ods/disparity/alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "tests/support/waves.h"

namespace ods {
namespace {

constexpr double kPi2 = 6.283185307179586;

// A parallax that changes with the direction, 1 to 5 degrees.
float parallax(float theta, float phi) {
  return 0.0524f + 0.0349f * std::sin(2.0f * theta + phi);
}

// The views of both eyes of the aligned pair. Many tests share them.
const GrayView& view_of(int width, bool right, float covers = 1.0f) {
  static const Waves world;
  static std::map<std::tuple<int, bool, float>, GrayView> views;
  GrayView& view = views[{width, right, covers}];
  if (view.width > 0) return view;
  view = GrayView(width, width / 2, 1);
  const float pixel = static_cast<float>(kPi2) / static_cast<float>(width);
  for (int y = 0; y < view.height; y++) {
    for (int x = 0; x < width; x++) {
      const float theta = pixel * (static_cast<float>(x) + 0.5f - 0.5f * static_cast<float>(width));
      const float phi = pixel * (0.5f * static_cast<float>(view.height) - static_cast<float>(y) - 0.5f);
      const float side = right ? 0.5f : -0.5f;
      const vec3 d = look_at_angles(theta + side * parallax(theta, phi), phi).direction;
      *view.at(x, y) = std::abs(theta) <= covers * 0.5f * static_cast<float>(kPi2) ? world(d) : NAN;
    }
  }
  return view;
}

EyeCorrection inverse(const EyeCorrection& small) {
  EyeCorrection result;
  result.raise = -small.raise, result.pitch = -small.pitch, result.roll = -small.roll, result.zoom = 1.0f / small.zoom;
  return result;
}

// `needed` makes the right eye agree with the left one.
Alignment found(const EyeCorrection& needed, float covers = 1.0f) {
  std::vector<std::vector<GrayView>> scales;
  for (const int width : {256, 512, 1024}) {
    const GrayView& right = view_of(width, true, covers);
    // The inverse of a single step is known.
    scales.push_back(
        {view_of(width, false, covers), moves_pixels(needed) ? corrected_view(right, inverse(needed)) : right});
  }
  return find_alignment(scales, covers < 0.8f);
}

void expect_terms(const Alignment& alignment, double raise, double pitch, double roll, double zoom) {
  EXPECT_NEAR(alignment.terms[kRaiseTerm].value, raise, 0.05);
  EXPECT_NEAR(alignment.terms[kPitchTerm].value, pitch, 0.05);
  EXPECT_NEAR(alignment.terms[kRollTerm].value, roll, 0.05);
  EXPECT_NEAR(alignment.terms[kZoomTerm].value, zoom, 0.001);
  for (const AlignmentTerm term : {kRaiseTerm, kPitchTerm, kRollTerm}) EXPECT_LT(alignment.terms[term].error, 0.05);
  EXPECT_GT(alignment.matches, 100);
  EXPECT_LT(alignment.unexplained, 0.1);
}

EyeCorrection needing(float EyeCorrection::*field, float value) {
  EyeCorrection needed;
  needed.*field = value;
  return needed;
}

TEST(Alignment, OfAlignedEyesIsNothing) {
  const Alignment alignment = found({});
  expect_terms(alignment, 0.0, 0.0, 0.0, 0.0);
  EXPECT_GT(alignment.headings, 10.0);
}

TEST(Alignment, FindsARaise) {
  for (const float degrees : {0.2f, -1.0f, 5.0f}) {
    expect_terms(found(needing(&EyeCorrection::raise, degrees)), double{degrees}, 0.0, 0.0, 0.0);
  }
}

TEST(Alignment, FindsAPitch) {
  for (const float degrees : {0.3f, -3.5f}) {
    expect_terms(found(needing(&EyeCorrection::pitch, degrees)), 0.0, double{degrees}, 0.0, 0.0);
  }
}

TEST(Alignment, FindsARoll) {
  for (const float degrees : {0.5f, -10.0f}) {
    expect_terms(found(needing(&EyeCorrection::roll, degrees)), 0.0, 0.0, double{degrees}, 0.0);
  }
}

TEST(Alignment, FindsAMagnification) {
  expect_terms(found(needing(&EyeCorrection::zoom, 1.02f)), 0.0, 0.0, 0.0, 0.02);
}

TEST(Alignment, TellsARaiseFromAPitchInHalfASphere) {
  expect_terms(found(needing(&EyeCorrection::raise, 1.0f), 0.5f), 1.0, 0.0, 0.0, 0.0);
  expect_terms(found(needing(&EyeCorrection::pitch, 1.0f), 0.5f), 0.0, 1.0, 0.0, 0.0);
}

// A view that is moved by whole pixels has the same numbers.
TEST(Alignment, CorrectsAView) {
  const GrayView& view = view_of(256, false);
  const GrayView raised = corrected_view(view, needing(&EyeCorrection::raise, 360.0f / 256.0f));
  for (int y = 0; y + 1 < view.height; y++) {
    for (int x = 0; x < view.width; x++) EXPECT_NEAR(*raised.at(x, y), *view.at(x, y + 1), 1e-3f);
  }
}

TEST(Alignment, OfNothingHasNoMatches) {
  const GrayView grey(256, 128, 1);
  const Alignment alignment = find_alignment({{grey, grey}}, false);
  EXPECT_EQ(alignment.matches, 0);
  EXPECT_EQ(alignment.headings, 0.0);
}

}  // namespace
}  // namespace ods
