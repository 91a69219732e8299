// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The nearest thing, for the one line of it: ods/comfort judges what it does to the eyes.
#include <fmt/format.h>

#include <algorithm>

#include "ods/comfort/matched.h"
#include "ods/lint/checks.h"
#include "ods/picture/picture.h"

namespace ods {

constexpr double kLeastMatched = 0.2;  // of the picture: less is no ground for a statement

void note_nearest(const Subject& subject, LintReport& report) {
  const std::vector<GrayView>& views = subject.scales[std::min<size_t>(1, subject.scales.size() - 1)];
  const MatchedEyes matched = match_views_for_depth(views, subject.format.camera);
  if (matched.share < kLeastMatched) return;
  const Image& depth = matched.seen[0].depth;
  float nearest = kFarDepth;
  size_t where = 0;
  for (size_t i = 0; i < depth.pixels.size(); i++) {
    if (depth.pixels[i] > 0.0f && depth.pixels[i] < nearest) nearest = depth.pixels[i], where = i;
  }
  if (!is_surface(nearest)) return;
  const auto width = static_cast<size_t>(depth.width);
  const double azimuth = 360.0 * ((static_cast<double>(where % width) + 0.5) / depth.width - 0.5);
  const double elevation = 180.0 * (0.5 - (static_cast<double>(where / width) + 0.5) / depth.height);
  report.notes.push_back(fmt::format("nearest thing about {:.2f} m away, {}, by matching the eyes: ods comfort judges it",
                                     nearest, direction_text(azimuth, elevation)));
}

}  // namespace ods
