// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the effects of too few code values: clipped highlights, and gradients with visible steps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ods/image/tone.h"
#include "ods/lint/checks.h"

namespace ods {

// --- highlights ------------------------------------------------------------------------------------------------------

constexpr int kGrid = 720;  // directions around the sphere

// The fraction of the sphere at the maximum code value, or of the picture if it is less than a sphere.
static double clipped_share(const Subject& subject) {
  const Projection projection = make_projection(subject.projection());
  const Image& eye = subject.eyes[0];
  double clipped = 0.0, all = 0.0;
  for (int y = 0; y < kGrid / 2; y++) {
    const float phi = kPi * (0.5f - (static_cast<float>(y) + 0.5f) / (kGrid / 2));
    for (int x = 0; x < kGrid; x++) {
      const float theta = 2.0f * kPi * ((static_cast<float>(x) + 0.5f) / kGrid - 0.5f);
      const ImagePoint place = place_of(projection, look_at_angles(theta, phi).direction);
      if (!place.seen) continue;
      const int column = std::min(static_cast<int>(place.uv.x * static_cast<float>(eye.width)), eye.width - 1);
      const int row = std::min(static_cast<int>(place.uv.y * static_cast<float>(eye.height)), eye.height - 1);
      const double weight = static_cast<double>(std::cos(phi));
      all += weight;
      if (*eye.at(column, row) > 0.999f) clipped += weight;
    }
  }
  return all > 0.0 ? clipped / all : 0.0;
}

static void check_highlights(const Subject& subject, LintReport& report) {
  judge(report, Check::kHighlights);
  const double share = clipped_share(subject);
  const double certainty = std::clamp((share - 0.005) / 0.03, 0.0, 1.0);
  if (certainty < 0.1) return;
  report.findings.push_back(
      {Fault::kClipped, certainty,
       fmt::format("{:.1f} % of the picture is pure white: no detail is left there", 100.0 * share),
       "reduce the exposure, or keep scene-linear light (.exr, .hdr) and roll highlights off "
       "(ods convert `exposure` -1 `tone` neutral)"});
}

// --- banding ---------------------------------------------------------------------------------------------------------

namespace {

constexpr float kFlat = 0.75f;     // code values: deviation within a stair from its mean
constexpr float kMinStair = 2.5f;  // code values: minimum step between stairs; 8-bit quantization makes steps of 1
constexpr float kMax = 24.0f;
constexpr int kWide = 6;     // minimum width of a stair, pixels
constexpr int kSteps = 3;    // consecutive steps that make stairs
constexpr int kAcross = 8;   // lines that are averaged
constexpr int kLines = 128;  // lines of each direction that are examined

// Counts stairs along a line: level runs that are connected by similar steps.
int stairs_in(const std::vector<float>& line) {
  int stairs = 0, steps = 0;
  size_t start = 0;
  float sum = line[0], last_step = 0.0f, last_level = NAN;
  for (size_t i = 1; i <= line.size(); i++) {
    const bool is_end = i == line.size();
    if (!is_end && std::abs(line[i] - sum / static_cast<float>(i - start)) <= kFlat) {
      sum += line[i];
      continue;
    }
    const bool is_wide = i - start >= kWide;
    const float level = line[start + (i - start) / 2], step = level - last_level;
    const bool is_like = steps == 0 || (step * last_step > 0.0f && std::abs(step - last_step) < 0.5f * std::abs(step));
    const bool is_step = is_wide && std::abs(step) >= kMinStair && std::abs(step) <= kMax && is_like;
    if (is_step) steps++;
    if (is_wide && !is_step) steps = 0;
    if (i - start > 2 && !is_wide) steps = 0;  // a slope, not a step
    if (steps == kSteps) stairs++, steps = 0;
    if (is_wide) last_level = level, last_step = is_step ? step : 0.0f;
    start = i, sum = is_end ? 0.0f : line[i];
  }
  return stairs;
}

// Code values 0..255 of green along a row or a column, each the mean across several lines, which removes noise but not
// stairs.
std::vector<float> codes_of(const Image& eye, bool is_row, int index) {
  std::vector<float> codes;
  const int count = is_row ? eye.width : eye.height, maximum = (is_row ? eye.height : eye.width) - 1;
  for (int i = 0; i < count; i++) {
    float light = 0.0f;
    for (int k = 0; k < kAcross; k++) {
      const int beside = std::min(index + k, maximum);
      light += std::clamp(is_row ? eye.at(i, beside)[1] : eye.at(beside, i)[1], 0.0f, 1.0f) / kAcross;
    }
    codes.push_back(255.0f * srgb_encode(light));
  }
  return codes;
}

}  // namespace

static void check_banding(const Subject& subject, LintReport& report) {
  judge(report, Check::kBanding);
  const Image& eye = subject.small[0];
  int stairs = 0, lines = 0, with = 0;
  for (const bool is_row : {true, false}) {
    const int all = is_row ? eye.height : eye.width, step = std::max(1, all / kLines);
    for (int i = step / 2; i < all; i += step) {
      const int found = stairs_in(codes_of(eye, is_row, i));
      lines++, stairs += found, with += found > 0 ? 1 : 0;
    }
  }
  const double share = static_cast<double>(with) / lines;
  const double certainty = std::clamp((share - 0.04) / 0.12, 0.0, 1.0);
  if (certainty < 0.1) return;
  report.findings.push_back({Fault::kBanding, certainty,
                             fmt::format("{:.0f} % of {} rows and columns have stairs of {} or more steps of {} to {} "
                                         "code values: {} in all",
                                         100.0 * share, lines, kSteps, kMinStair, kMax, stairs),
                             "keep 10 bits or more until the last step, or add grain before it"});
}

void check_codes(const Subject& subject, LintReport& report) {
  if (subject.info.is_float) {
    for (const Check check : {Check::kHighlights, Check::kBanding})
      skip(report, check, "scene-linear light has no steps");
    return;
  }
  check_highlights(subject, report);
  check_banding(subject, report);
}

}  // namespace ods
