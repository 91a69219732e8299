// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The sign of parallax around the horizon: + everywhere is correct; - everywhere means swapped eyes; cos(theta) means
// two fixed cameras; cos(2 theta) means a viewing circle that was mirrored without its rays. The amount of parallax
// depends on the scene and is not evidence, except that a picture without any parallax has one eye twice.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ods/base/median.h"
#include "ods/disparity/match.h"
#include "ods/lint/checks.h"

namespace ods {

namespace {

constexpr int kSectors = 16;
constexpr double kPrecision = 0.25;  // precision of a match, in pixels of its view
constexpr double kGrounded = 0.2;    // a value of growth_downwards() beyond coincidence
constexpr double kPi2 = 2.0 * std::numbers::pi;

struct Parallax {
  double theta = 0.0;
  double phi = 0.0;
  double angle = 0.0;  // radians, for a parallel pair
  double sign = 0.0;   // -1..1: near 0 if the angle is smaller than the precision
  double weight = 0.0;
  int sector = 0;
};

struct Parallaxes {
  std::vector<Parallax> all;
  double sectors = 0.0;  // number of sectors with matches, 0..kSectors
};

// The agreement of a pattern of signs with the data, -1..1.
template <class Pattern>
double explained(const Parallaxes& parallaxes, Pattern pattern) {
  double sum = 0.0, maximum = 0.0;
  for (const Parallax& each : parallaxes.all) {
    const double expected = std::clamp(2.0 * pattern(each.theta), -1.0, 1.0);
    sum += each.weight * each.sign * expected;
    maximum += each.weight * std::abs(each.sign * expected);
  }
  return maximum > 0.0 ? sum / maximum : 0.0;
}

// cos(waves (theta - turn)), with the turn that explains the data best.
struct Wave {
  double share = 0.0;
  double turn = 0.0;
};
Wave best_wave(const Parallaxes& parallaxes, int waves) {
  Wave best;
  for (int i = 0; i < 24; i++) {
    const double turn = kPi2 * i / (24.0 * waves);
    const double share = explained(parallaxes, [&](double theta) { return std::cos(waves * (theta - turn)); });
    if (share > best.share) best = {share, std::remainder(turn, kPi2) * 360.0 / kPi2};
  }
  return best;
}

void add_matches(Parallaxes& parallaxes, const Matches& matches, const Subject& subject) {
  for (const Match& match : matches.found) {
    Parallax each;
    each.theta = static_cast<double>(match.theta);
    each.phi = static_cast<double>(match.phi);
    each.angle = static_cast<double>(match.around) + convergence_at(subject, each.phi);
    const double in_precisions = each.angle / (kPrecision * static_cast<double>(matches.pixel));
    each.sign = std::copysign(std::tanh(in_precisions * in_precisions), in_precisions);
    each.sector = std::clamp(static_cast<int>((each.theta / kPi2 + 0.5) * kSectors), 0, kSectors - 1);
    parallaxes.all.push_back(each);
  }
}

// Weights each sector, so that one full of detail counts little more than one with some detail.
void weigh(Parallaxes& parallaxes) {
  std::array<double, kSectors> count{};
  for (const Parallax& each : parallaxes.all) count[static_cast<size_t>(each.sector)] += std::abs(each.sign);
  for (Parallax& each : parallaxes.all) each.weight = 1.0 / (count[static_cast<size_t>(each.sector)] + 1.0);
  for (double each : count) parallaxes.sectors += each / (each + 1.0);
}

// Evidence that angular parallax grows downwards below the horizon, -1..1, judged at each heading separately. It does
// for eyes in the right order, because the ground gets closer, wherever the eyes converge; it decreases if they are
// swapped.
double growth_downwards(const Parallaxes& parallaxes) {
  struct Sums {
    double weight = 0.0, depth = 0.0, angle = 0.0;
  };
  std::array<Sums, kSectors> sums;
  const auto arc_of = [](const Parallax& each) { return each.angle * std::cos(each.phi); };
  const auto counts = [](const Parallax& each) { return each.phi < 0.0; };
  for (const Parallax& each : parallaxes.all) {
    if (!counts(each)) continue;
    Sums& sector = sums[static_cast<size_t>(each.sector)];
    sector.weight += 1.0, sector.depth -= each.phi, sector.angle += arc_of(each);
  }
  double both = 0.0, depths = 0.0, angles = 0.0;
  for (const Parallax& each : parallaxes.all) {
    const Sums& sector = sums[static_cast<size_t>(each.sector)];
    if (!counts(each) || sector.weight < 3.0) continue;
    const double depth = -each.phi - sector.depth / sector.weight, angle = arc_of(each) - sector.angle / sector.weight;
    both += depth * angle, depths += depth * depth, angles += angle * angle;
  }
  return depths > 0.0 && angles > 0.0 ? both / std::sqrt(depths * angles) : 0.0;
}

}  // namespace

// Toed-in rays meet on a sphere: towards the poles they rotate about increasingly smaller circles.
double convergence_at(const Subject& subject, double phi) {
  if (!subject.camera || subject.camera->convergence == kParallel) return 0.0;
  const Camera& camera = *subject.camera;
  if (camera.convergence == kShift) return 2.0 * static_cast<double>(shift_angle(camera, kRight));
  const float left = merge_factor(phi < 0.0 ? camera.bottom : camera.top, static_cast<float>(std::abs(phi)));
  return 2.0 * std::atan(static_cast<double>(0.5f * camera.ipd * left / camera.convergence_distance) / std::cos(phi));
}

// --- one eye twice -------------------------------------------------------------------------------------------------

namespace {

struct Stillness {
  double certainty = 0.0;
  double middle = 0.0;  // median of the parallax, in pixels of the view
  double spread = 0.0;
  size_t count = 0;
};

// Distant objects have small parallax too, but it is not noise: it is never negative.
Stillness stillness_of(const Matches& matches) {
  Stillness still;
  still.count = matches.found.size();
  if (still.count < 10) return still;
  std::vector<double> angles, deviations;
  for (const Match& match : matches.found) angles.push_back(static_cast<double>(match.around / matches.pixel));
  still.middle = median(angles);
  for (double angle : angles) deviations.push_back(std::abs(angle - still.middle));
  still.spread = median(deviations);
  const double count = static_cast<double>(still.count);
  double balance = 0.0;
  for (double angle : angles) balance += std::tanh(angle / (still.spread + 1e-3)) / count;
  // A few moving objects, as on a test card, suffice if they move in one direction, unlike mismatches.
  double moving = 0.0, sense = 0.0;
  for (double angle : angles) {
    if (std::abs(angle - still.middle) < std::max(0.5, 6.0 * still.spread)) continue;
    moving += 1.0;
    sense += angle > still.middle ? 1.0 : -1.0;
  }
  const double alive = std::clamp(0.5 * (std::abs(sense) / std::sqrt(moving + 1.0) - 1.0), 0.0, 1.0);
  still.certainty = count / (count + 10.0) * std::max(0.0, 1.0 - still.spread / 0.4) *
                    std::max(0.0, 1.0 - 2.0 * std::abs(balance)) * (1.0 - alive);
  return still;
}

}  // namespace

// Judges at all scales: noise that is the same in both eyes has no parallax either,
// but only where it is not averaged out.
static bool check_twice(const Subject& subject, const std::vector<Matches>& scales, LintReport& report) {
  const std::vector<Image>& eyes = subject.eyes;
  const char* remedy = "render both eyes, from two places; if only one was ever made, save it as one eye (mono)";
  const int detailed = scales.back().tiles;
  if (detailed > 0 && eyes[0].pixels == eyes[1].pixels) {
    judge(report, Check::kTwoEyes);
    report.findings.push_back({Fault::kOneEyeTwice, 1.0, "every pixel is the same in both eyes", remedy});
    return true;
  }
  Stillness minimum{2.0, 0.0, 0.0, 0};
  double degrees = 0.0;
  for (const Matches& matches : scales) {
    const Stillness still = stillness_of(matches);
    if (still.certainty >= minimum.certainty) continue;
    minimum = still;
    degrees = static_cast<double>(matches.pixel) * 360.0 / kPi2;
  }
  // In small pictures, objects that are merely distant have no measurable parallax either.
  const double width = kPi2 / static_cast<double>(scales.back().pixel);
  const double large = std::clamp((width - 256.0) / 768.0, 0.0, 1.0);
  minimum.certainty *= large;
  if (detailed == 0) {
    skip(report, Check::kTwoEyes, "not enough detail");
  } else if (large < 0.5) {
    skip(report, Check::kTwoEyes,
         fmt::format("at {:.0f} pixels around, distant things have no parallax either", width));
  } else {
    judge(report, Check::kTwoEyes);
  }
  if (minimum.certainty < 0.1) return false;
  report.findings.push_back(
      {Fault::kOneEyeTwice, minimum.certainty,
       fmt::format("{} places are at the same spot in both eyes: {:.3f} degrees apart, give or take {:.3f}",
                   minimum.count, minimum.middle * degrees, minimum.spread * degrees),
       remedy});
  return minimum.certainty > 0.5;
}

// --- the signs -----------------------------------------------------------------------------------------------------

constexpr double kConclusive = 0.3;  // minimum fraction of one sign

// Returns the certainty that the eyes are swapped.
static double check_swap(const Subject& subject, const Parallaxes& parallaxes, double upright, LintReport& report) {
  const double enough = parallaxes.sectors / (parallaxes.sectors + 2.0);
  double certainty = std::max(0.0, -upright * enough);
  std::string evidence = fmt::format("the left eye sees {:.0f} % of {} places farther left than the right eye does",
                                     50.0 - 50.0 * upright, parallaxes.all.size());
  if (!subject.camera) {
    const double growth = growth_downwards(parallaxes);
    // Eyes that converge at mid-distance have parallax of both signs; if they converge nearby, only the ground decides.
    certainty *= std::clamp((-upright - 0.5) / 0.4, 0.0, 1.0) * (0.5 - 0.5 * std::tanh(6.0 * (growth - kGrounded)));
    evidence += growth < kGrounded ? "" : ", but the less so the nearer the ground: they may converge close by";
  }
  if (std::abs(upright) * enough < kConclusive) {
    skip(report, Check::kEyeOrder, "too little parallax of one sign");
  } else if (upright < 0.0 && certainty < 0.5) {
    skip(report, Check::kEyeOrder, "its parallax is that of swapped eyes, or of eyes that converge close by");
  } else {
    judge(report, Check::kEyeOrder);
  }
  if (upright > -0.1) return 0.0;
  const EyeArrangement eyes = arrangement_of(subject.layout());
  const bool stacked = eyes.how == EyePacking::kStacked && !eyes.right_first;
  const char* remedy = stacked && !eyes.squeezed
                           ? "the right eye is on top: swap the halves, or set the player to bottom-top"
                       : stacked ? "the right eye is on top: exchange the halves"
                                 : "swap the eyes, or set the player to the other order";
  report.findings.push_back({stacked ? Fault::kRightOnTop : Fault::kEyesSwapped, certainty, evidence, remedy});
  return certainty;
}

// The agreement of a magnified eye with the signs. Magnification also causes vertical differences, unlike parallax.
static double explained_by_zoom(const Subject& subject, const Parallaxes& parallaxes) {
  constexpr double kSurely = 3.0;  // standard errors
  const Alignment::Term& zoom = subject.alignment.terms[kZoomTerm];
  if (std::abs(zoom.value) < kSurely * zoom.error) return 0.0;
  return std::abs(explained(parallaxes, [](double theta) { return 2.0 * theta / kPi2; }));
}

static void check_waves(const Subject& subject, const Parallaxes& parallaxes, double upright, LintReport& report) {
  const Wave one = best_wave(parallaxes, 1), two = best_wave(parallaxes, 2);
  const double enough = parallaxes.sectors / (parallaxes.sectors + 2.0);
  const auto add = [&](Fault fault, const Wave& wave, double other, const char* shape, const char* remedy) {
    const double certainty = enough * (wave.share - std::max(std::abs(upright), other));
    if (certainty < 0.1) return;
    report.findings.push_back({fault, certainty,
                               fmt::format("parallax changes its sign with the heading as cos({}) does, about {:.0f} "
                                           "degrees: that explains {:.0f} % of it, one sign {:.0f} %",
                                           shape, wave.turn, 50.0 + 50.0 * wave.share, 50.0 + 50.0 * std::abs(upright)),
                               remedy});
  };
  add(Fault::kTwoCameras, one, std::max(two.share, explained_by_zoom(subject, parallaxes)), "theta",
      "render again with a viewing circle (omni-directional stereo); pictures of two fixed cameras cannot be repaired");
  add(Fault::kMirroredCircle, two, one.share, "2 theta",
      "the renderer turns its eyes and its rays in opposite directions: negate one coordinate of the eye's position "
      "there, and render again");
}

void check_parallax(const Subject& subject, LintReport& report) {
  Parallaxes parallaxes;
  for (const Matches& matches : subject.matches) add_matches(parallaxes, matches, subject);
  const double around = seen_around(subject.scales.back()[0]);
  if (check_twice(subject, subject.matches, report)) {
    for (const Check check : {Check::kEyeOrder, Check::kCircle, Check::kConvergence}) {
      skip(report, check, "both eyes see the same picture");
    }
    return;
  }
  weigh(parallaxes);
  const double upright = explained(parallaxes, [](double) { return 1.0; });
  if (parallaxes.sectors < 1.5) {
    for (const Check check : {Check::kEyeOrder, Check::kCircle, Check::kConvergence}) {
      skip(report, check, "not enough detail with parallax");
    }
    return;
  }
  check_divergence(subject, check_swap(subject, parallaxes, upright, report), report);
  if (around < 0.8) {
    skip(report, Check::kCircle, "the picture does not go all around");
    return;
  }
  judge(report, Check::kCircle);
  check_waves(subject, parallaxes, upright, report);
}

}  // namespace ods
