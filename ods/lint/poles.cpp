// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Checks stereo at the poles. On a floor or ceiling at the height h, parallax without a merge is constant as the eye
// sees it, ipd / h, at any distance from the pole. It is correct for one heading only; at all others it strains the
// eyes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ods/base/angles.h"
#include "ods/base/median.h"
#include "ods/disparity/match.h"
#include "ods/lint/checks.h"

namespace ods {

namespace {

// Eyes do not fuse pictures that differ in height by more than 19 to 26 minutes of arc, depending on the source.
constexpr double kTolerable = 0.43;

struct Band {
  double arc = 0.0;  // degrees as the eye sees it: the difference of headings times cos(phi)
  int count = 0;
};

Band measure(const Subject& subject, const Matches& matches, bool top, double from, double to) {
  std::vector<double> arcs;
  for (const Match& match : matches.found) {
    const double phi = static_cast<double>(top ? match.phi : -match.phi);
    if (phi < from * kDegree || phi > to * kDegree) continue;
    arcs.push_back((static_cast<double>(match.around) + convergence_at(subject, static_cast<double>(match.phi))) *
                   std::cos(phi) / kDegree);
  }
  if (arcs.empty()) return {};
  return {std::abs(median(arcs)), static_cast<int>(arcs.size())};
}

}  // namespace

// Normalizes the exposure, so that the visibility does not depend on it. As in the other scales, the right view is
// corrected.
static std::vector<GrayView> evenly_exposed(const Subject& subject) {
  const int width = subject.scales[1][0].width;
  std::vector<GrayView> views = make_gray_views(subject.eyes, subject.projection(), true, width);
  if (moves_pixels(subject.correction)) views[1] = corrected_view(views[1], subject.correction);
  return views;
}

void check_poles(const Subject& subject, LintReport& report) {
  const std::vector<GrayView> views = evenly_exposed(subject);
  Search search;
  search.rows = std::max(4, views[0].height / 36);
  search.columns = std::max(4, views[0].width / 30);
  search.step = std::max(1, search.rows / 3);
  search.around = 0.9f;
  std::vector<Matches> regions;
  for (const auto& [low, high] : {std::pair{-88.0, -60.0}, std::pair{60.0, 88.0}}) {
    search.lowest = static_cast<float>(low * kDegree), search.highest = static_cast<float>(high * kDegree);
    regions.push_back(match_tiles(views[0], views[1], search));
  }
  for (const bool top : {true, false}) {
    const char* name = top ? "top" : "bottom";
    const Check check = top ? Check::kTopPole : Check::kBottomPole;
    const Matches& matches = regions[top ? 1 : 0];
    const Band off = measure(subject, matches, top, 60.0, 72.0);
    const Band near = measure(subject, matches, top, 77.0, 88.0);
    if (off.count < 3 || near.count < 3) {
      skip(report, check, "not enough detail");
      continue;
    }
    judge(report, check);
    const double kept = std::clamp((near.arc / std::max(off.arc, 0.05) - 0.5) / 0.4, 0.0, 1.0);
    const double matters = near.arc / (near.arc + 0.5 * kTolerable);
    const double certainty = kept * matters * near.count / (near.count + 2.0);
    if (near.arc < kTolerable || certainty < 0.1) continue;
    report.findings.push_back(
        {Fault::kNoPoleMerge, certainty,
         fmt::format(
             "at the {} the eyes' pictures differ by {:.1f} degrees within 13 degrees of the pole, {:.1f} at 66 "
             "degrees; more than {} strains the eyes of anyone who looks there",
             name, near.arc, off.arc, kTolerable),
         fmt::format("render with a pole merge, as `merge-{}` cosine,60,90", name)});
  }
}

}  // namespace ods
