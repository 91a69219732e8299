// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/eye_match.h"

#include <algorithm>
#include <cmath>

#include "ods/disparity/match.h"

namespace ods {

namespace {

// Low resolution averages noise out and makes the match less sensitive to parallax.
constexpr int kCoarseWidth = 192;

// Without parallax: the share of places that a repeated pattern may have in common, and that two eyes have.
constexpr double kRepeats = 0.8, kSame = 0.9;
constexpr double kMatchPrecision = 0.25;  // precision of a match, in pixels of its view

double sign_of(const Match& match, float pixel) {
  const double moved = static_cast<double>(match.around / pixel) / kMatchPrecision;
  return std::copysign(std::tanh(moved * moved), moved);
}

}  // namespace

double EyeMatch::mark() const {
  const double known = places / (places + 8.0);
  const double alike = std::clamp((share - 0.35) / 0.25, -1.0, 1.0);
  const double is_parallax = is_still ? std::clamp((share - kRepeats) / (kSame - kRepeats), 0.0, 1.0) : one_sign;
  return known * (alike > 0.0 ? alike * std::min(1.0, 0.2 + 2.0 * is_parallax) : alike);
}

EyeMatch match_eyes(const std::vector<Image>& eyes) {
  const std::vector<GrayView> views = make_gray_views(eyes, ProjectionSetting(), false, kCoarseWidth);
  Search search;
  search.correlation = 0.7f;
  search.down = 0.05f;
  const Matches matches = match_tiles(views[0], views[1], search);
  EyeMatch match;
  match.places = matches.tiles;
  match.share = matches.share();
  double signs = 0.0, moved = 0.0;
  for (const Match& each : matches.found) {
    signs += sign_of(each, matches.pixel);
    moved += static_cast<double>(std::abs(each.around) / matches.pixel);
  }
  const double count = static_cast<double>(matches.found.size());
  if (count > 0.0) match.one_sign = std::abs(signs) / count, match.is_still = moved < 0.3 * count;
  return match;
}

}  // namespace ods
