// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds pictures, or eyes of them, that are black.
#include <fmt/format.h>

#include <algorithm>

#include "ods/lint/checks.h"

namespace ods {

constexpr float kBlack = 0.0025f;  // scene-linear: 8 of 255
constexpr double kLit = 0.001;     // minimum fraction of lit pixels for a picture

static double lit_share(const Image& eye) {
  const auto lit = std::count_if(eye.pixels.begin(), eye.pixels.end(), [](float light) { return light > kBlack; });
  return static_cast<double>(lit) / static_cast<double>(eye.pixels.size());
}

void check_black(const Subject& subject, LintReport& report) {
  if (subject.is_video) return skip(report, Check::kBlack, "videos may have black frames");
  judge(report, Check::kBlack);
  size_t black = 0;
  for (const Image& eye : subject.eyes) black += lit_share(eye) < kLit ? 1 : 0;
  if (black == 0) return;
  const bool is_left = lit_share(subject.eyes[0]) < kLit;
  const char* what = black == subject.eyes.size() ? "the picture" : is_left ? "the left eye" : "the right eye";
  report.findings.push_back({Fault::kBlack, 1.0,
                             fmt::format("of {}, fewer than one pixel in a thousand is brighter than 8 of 255", what),
                             "light the scene, increase the exposure, or check whether it is the right file"});
}

}  // namespace ods
