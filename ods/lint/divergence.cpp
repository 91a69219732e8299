// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds eyes that must turn outwards. Very distant points have no parallax, closer ones have it inwards. So if most
// distant points have parallax outwards, one picture is turned against the other, which is painful to view: eyes
// diverge by at most a degree (Shibata et al., "The zone of comfort", 2011).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ods/base/angles.h"
#include "ods/comfort/matched.h"
#include "ods/lint/checks.h"
#include "ods/picture/picture.h"

namespace ods {

namespace {

constexpr double kHighest = 50.0;  // degrees: closer to the poles, a difference of headings is a small angle
constexpr double kFar = 0.25;      // the fraction of the places that is considered distant
constexpr double kHarmless = 0.3, kPainful = 0.7;  // degrees; reported from the middle between them on
constexpr size_t kMinPlaces = 20;                  // places

// The parallax at this percentile; its error is a quarter of the spread between its neighbours.
Difference percentile(std::vector<double> angles, double share) {
  std::sort(angles.begin(), angles.end());
  const auto at = [&](double part) {
    const double place = std::clamp(part, 0.0, 1.0) * static_cast<double>(angles.size() - 1);
    return angles[static_cast<size_t>(std::lround(place))];
  };
  const double reach = 1.0 / std::sqrt(static_cast<double>(angles.size()));
  return {at(share), 0.25 * (at(share + reach) - at(share - reach)), angles.size()};
}

}  // namespace

void check_divergence(const Subject& subject, double swapped, LintReport& report) {
  std::vector<double> angles;
  for (const Match& match : subject.matches.back().found) {
    const double phi = static_cast<double>(match.phi);
    if (std::abs(phi) > kHighest * kDegree) continue;
    angles.push_back((static_cast<double>(match.around) + convergence_at(subject, phi)) / kDegree);
  }
  if (angles.size() < kMinPlaces) return skip(report, Check::kConvergence, "not enough detail that both eyes show");
  judge(report, Check::kConvergence);
  Difference far = percentile(angles, kFar);
  const double yaw = -far.size;
  far.size = std::max(0.0, yaw);
  // Either the eyes are swapped or they diverge: doubt about which of the two makes neither unlikely by itself.
  const double certainty = std::min(certainty_of(far, kHarmless, kPainful), 1.0 - swapped);
  if (certainty < 0.1) return;
  report.findings.push_back(
      {Fault::kEyesDiverge, certainty,
       fmt::format(
           "at a quarter of {} places the parallax is outward by {:.2f} degrees or more, +-{:.2f}: eyes that look "
           "at what is far must diverge by that",
           angles.size(), yaw, far.error),
       "turn the cameras inwards, or turn the picture: " +
           convert_command(subject, fmt::format("`right-yaw` {:.2f}", yaw))});
}

// --- the nearest object

constexpr double kMinSure = 0.2;  // minimum matched fraction of the picture for a statement

void note_nearest(const Subject& subject, LintReport& report) {
  const std::vector<GrayView>& views = subject.scales[std::min<size_t>(1, subject.scales.size() - 1)];
  const MatchedEyes matched = match_views_for_depth(views, subject.format.camera);
  if (matched.share < kMinSure) return;
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
  report.notes.push_back(
      fmt::format("nearest thing about {:.2f} m away, {}, by matching the eyes: ods comfort judges it", nearest,
                  direction_text(azimuth, elevation)));
}

}  // namespace ods
