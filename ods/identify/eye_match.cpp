// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/eye_match.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ods/disparity/match.h"

namespace ods {

namespace {

// Low resolution averages noise out and makes the match less sensitive to parallax.
constexpr int kCoarseWidth = 192;

// Without parallax: the share of places that a repeated pattern may have in common, and that two eyes have.
constexpr double kRepeats = 0.8, kSame = 0.9;
// After a shift has been found: the share of places that similar things may have in common, and that two eyes have.
constexpr double kSome = 0.45, kMost = 0.65;
constexpr double kMatchPrecision = 0.25;  // precision of a match, in pixels of its view

constexpr int kReduced = 2;  // pixels of a view, for finding a shift

double sign_of(const Match& match, float pixel) {
  const double moved = static_cast<double>(match.around / pixel) / kMatchPrecision;
  return std::copysign(std::tanh(moved * moved), moved);
}

}  // namespace

double EyeMatch::mark() const {
  const double known = places / (places + 8.0);
  const double alike = std::clamp((share - 0.35) / 0.25, -1.0, 1.0);
  const double is_parallax = is_shifted ? std::clamp((share - kSome) / (kMost - kSome), 0.0, 1.0)
                             : is_still ? std::clamp((share - kRepeats) / (kSame - kRepeats), 0.0, 1.0)
                                        : one_sign;
  return known * (alike > 0.0 ? alike * std::min(1.0, 0.2 + 2.0 * is_parallax) : alike);
}

static EyeMatch compare(const GrayView& left, const GrayView& right) {
  Search search;
  search.correlation = 0.7f;
  search.down = 0.05f;
  const Matches matches = match_tiles(left, right, search);
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

// --- eyes that are shifted as a whole ---

namespace {

struct WholeShift {
  int x = 0, y = 0;  // pixels of a view
};

// The differences of a view's pixels from the mean around them, reduced by kReduced; 0 where the picture ends.
Image details_of(const GrayView& view) {
  const int width = view.width / kReduced, height = view.height / kReduced;
  Image small(width, height, 1), details(width, height, 1);
  for (int y = 0; y < height; y++) {
    for (int x = 0; x < width; x++) {
      float sum = 0.0f;
      for (int i = 0; i < kReduced * kReduced; i++)
        sum += *view.at(kReduced * x + i % kReduced, kReduced * y + i / kReduced);
      *small.at(x, y) = sum / (kReduced * kReduced);
    }
  }
  constexpr int kAround = 4;
  for (int y = 0; y < height; y++) {
    for (int x = 0; x < width; x++) {
      float sum = 0.0f, count = 0.0f;
      for (int v = std::max(0, y - kAround); v <= std::min(height - 1, y + kAround); v++) {
        for (int u = std::max(0, x - kAround); u <= std::min(width - 1, x + kAround); u++) {
          sum += *small.at(u, v), count += 1.0f;
        }
      }
      const float detail = *small.at(x, y) - sum / count;
      *details.at(x, y) = std::isfinite(detail) ? detail : 0.0f;
    }
  }
  return details;
}

double correlation_at(const Image& left, const Image& right, WholeShift by) {
  double both = 0.0, one = 0.0, other = 0.0;
  for (int y = std::max(0, -by.y); y < std::min(left.height, left.height - by.y); y++) {
    for (int x = std::max(0, -by.x); x < std::min(left.width, left.width - by.x); x++) {
      const double a = static_cast<double>(*left.at(x, y)), b = static_cast<double>(*right.at(x + by.x, y + by.y));
      both += a * b, one += a * a, other += b * b;
    }
  }
  return one > 0.0 && other > 0.0 ? both / std::sqrt(one * other) : 0.0;
}

// The shift of the right view that makes it most like the left one.
WholeShift find_shift(const GrayView& left, const GrayView& right) {
  constexpr int kAcross = 12, kDown = 6;  // an eighth and a sixteenth of the width
  const Image one = details_of(left), other = details_of(right);
  WholeShift best;
  double most = 0.0;
  for (int y = -kDown; y <= kDown; y++) {
    for (int x = -kAcross; x <= kAcross; x++) {
      const double correlation = correlation_at(one, other, {x, y});
      if (correlation > most) most = correlation, best = {kReduced * x, kReduced * y};
    }
  }
  return best;
}

GrayView shifted(const GrayView& view, WholeShift by) {
  GrayView result(view.width, view.height, 1);
  for (int y = 0; y < view.height; y++) {
    for (int x = 0; x < view.width; x++) {
      const int u = x + by.x, v = y + by.y;
      const bool is_inside = u >= 0 && v >= 0 && u < view.width && v < view.height;
      *result.at(x, y) = is_inside ? *view.at(u, v) : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return result;
}

}  // namespace

EyeMatch match_eyes(const std::vector<Image>& eyes) {
  const std::vector<GrayView> views = make_gray_views(eyes, ProjectionSetting(), false, kCoarseWidth);
  const EyeMatch match = compare(views[0], views[1]);
  if (match.mark() > 0.0) return match;
  EyeMatch moved = compare(views[0], shifted(views[1], find_shift(views[0], views[1])));
  moved.is_shifted = true;
  return moved.mark() > 0.0 ? moved : match;
}

}  // namespace ods
