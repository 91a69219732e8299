// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The strain of a viewer's eyes by a point of an omni-directional stereo picture in a headset, in closed form.
//
// A headset shows the eyes' pictures by direction. A point at the azimuth alpha is at alpha + delta in the left eye's
// picture and at alpha - delta in the right one's, at the same elevation phi in both; delta, the half parallax, is
// asin(r / rho) for eyes on a circle of radius r and a point at the distance rho from its axis. A pair of eyes fixed to
// a head would see the point at one height, whatever the head's yaw; the pictures show it at two as soon as the head is
// turned aside. The eyes must then diverge vertically: the vertical disparity
//
//   V(beta) = atan2(tan phi, cos(beta + delta)) - atan2(tan phi, cos(beta - delta))
//
// for a head whose yaw is beta from the point; the head's pitch does not matter. A head whose ears are not level sees
// the vergence itself tilted, in every stereo picture: while it looks straight at the point, vertical disparity is the
// vergence times the sine of its roll. Both together are in docs/comfort.md. Source: derived from the projection of
// Google, "Rendering Omni-directional Stereo Content"; tests/comfort/strain_test.cpp searches head poses for worse
// ones.
//
// Angles are radians unless a name says otherwise, lengths metres.
#pragma once
#include <string_view>

#include "ods/base/enum_array.h"
#include "ods/base/names.h"

namespace ods {

struct Viewer {
  float ipd = 0.065f;          // between the pupils
  float focus = 1.3f;          // distance at which the headset's lenses focus; may be infinite
  float gaze_degrees = 15.0f;  // largest turn of the eyes before the head follows
  float roll_degrees = 0.0f;   // largest tilt of the line through the ears
};

// The kinds of strain.
enum class Strain {
  kNear,      // the eyes converge nearer than they focus; in dioptres of the distance for which they converge
  kVertical,  // worst_vertical_disparity(), in minutes of arc
  kStep,      // difference of vergence to things a degree beside it, in degrees
  kEdge,      // vergence of a thing cut by the side of a picture that does not go all around, in degrees
  kRule,      // breach of a rule of ComfortOptions: the required distance over the actual one
};

struct StrainRow {
  Strain member;
  std::string_view name;
  std::string_view unit;
  std::string_view title;
  std::string_view source;  // source of the limits
};
inline constexpr StrainRow kStrainTable[] = {
    {Strain::kNear, "near", "dioptres", "the eyes converge nearer than they focus",
     "caution: the one-degree rule (provisional); warning: Shibata et al. 2011, The zone of comfort (its numbers "
     "provisional); error: Google's 60 cm"},
    {Strain::kVertical, "vertical", "minutes of arc", "the eyes must diverge vertically when the head turns",
     "caution: provisional; warning: Qin et al., limits of Panum's area; error: a degree, which is severe"},
    {Strain::kStep, "step", "degrees", "a large step in depth to its neighbour",
     "Nagata 2002, limits of fusion of 392 people"},
    {Strain::kEdge, "edge", "degrees", "the picture's side cuts it, and one eye shows more of it",
     "as for `step`; provisional"},
    {Strain::kRule, "rule", "times too near", "nearer than the rule allows", ""},
};
static_assert(has_every_member(kStrainTable));
inline constexpr auto kStrains = members_of(kStrainTable);
constexpr const StrainRow& strain_row(Strain strain) {
  return row_in(kStrainTable, strain);
}

enum class ComfortLevel { kOk, kCaution, kWarning, kError };
inline constexpr NameRow<ComfortLevel> kComfortLevelTable[] = {
    {ComfortLevel::kOk, "ok"},
    {ComfortLevel::kCaution, "caution"},
    {ComfortLevel::kWarning, "warning"},
    {ComfortLevel::kError, "error"},
};
static_assert(has_every_member(kComfortLevelTable));
inline constexpr auto kComfortLevels = members_of(kComfortLevelTable);
constexpr std::string_view comfort_level_name(ComfortLevel level) {
  return name_in(kComfortLevelTable, level);
}

// The frequency of looks at this elevation, per solid angle, relative to the horizon. Source: Sitzmann et al. 2018,
// "Saliency in VR": a Laplace distribution of elevations, 18.6 degrees wide; provisional, quoted from memory.
double gaze_density(double elevation);

inline constexpr double kFusionLimit = 25.6;                     // minutes of arc: beyond this kVertical is a warning
inline constexpr double kGoogleAhead = 0.6, kGoogleAbove = 3.5;  // metres: Google's minimum distances

// A value above a limit has that level. Infinite if no value has the level.
struct StrainLimits {
  double caution, warning, error;
};
StrainLimits strain_limits(Strain strain, const Viewer& viewer);
EnumArray<Strain, StrainLimits> strain_limits(const Viewer& viewer);
ComfortLevel level_of(double value, const StrainLimits& limits);

// The position of a point in the pictures, for eyes on a circle of this radius. The point is `across` from the circle's
// axis, farther than the radius, and `height` above its plane.
struct CircleView {
  double half_parallax, elevation;
};
CircleView seen_from_circle(double radius, double across, double height);

// The angle between the eyes' lines of sight when they look at the point; negative if they must diverge.
double vergence(double half_parallax, double elevation);

// The distance for which eyes converge by this angle, as dioptres: 1 / metres. 0 or less: beyond everything.
double vergence_dioptres(double vergence, const Viewer& viewer);

// Returns V of the formula at the top of this file.
double vertical_disparity(double half_parallax, double elevation, double head_yaw);

// The allowed poses of a head: the point is at most `gaze` away from straight ahead, the line through the ears at most
// `roll` out of level.
struct HeadReach {
  double gaze = 0.0, roll = 0.0;
};
HeadReach reach_of(const Viewer& viewer);

// The largest vertical disparity over all such heads, of any yaw and pitch.
double worst_vertical_disparity(double half_parallax, double elevation, const HeadReach& reach);

// The roll, up to a quarter turn, at which the worst vertical disparity equals the limit; 0 if it exceeds the limit
// with level ears.
double roll_for_disparity(double half_parallax, double elevation, double gaze, double limit);

}  // namespace ods
