// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a stereo picture does to the eyes of its viewer, judged by its depth: where it strains them, how much, and what
// would cure it. docs/comfort.md explains the report.
//
// Every pixel of one eye is judged by where that eye shows its point; the other eye shows it as far on the other side.
// That holds for level viewing circles with pole merges of every kind, convergence and necks. Eyes that a head-tilt map
// tilts are judged as if they were level.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "ods/camera/stereo_camera.h"
#include "ods/comfort/strain.h"
#include "ods/image/image.h"

namespace ods {

enum class ComfortRules {
  kStrain,      // what the strains' papers say
  kGoogle,      // nothing nearer than 0.6 m at the horizon and 3.5 m at the poles, for eyes 65 mm apart
  kSafeSphere,  // nothing nearer than ComfortOptions::safe_radius
};

struct ComfortOptions {
  Viewer viewer;
  ComfortRules rules = ComfortRules::kStrain;
  float safe_radius = 1.0f;  // metres
};

// What one eye of a picture shows: how far, and, where it is known, what.
struct SeenDepth {
  StereoCamera camera;
  int eye = kLeft;          // kMono: it is judged as if two eyes saw the same
  Image depth;              // 1 channel, as EyeImage::depth; less than 0 and NaN: unknown
  std::vector<int> things;  // of each pixel, index in `names`; negative: nothing. Empty: unknown
  std::vector<std::string> names;
};

// A thing that strains, or an area if things have no names.
struct StrainedPlace {
  std::string name;
  Strain strain = Strain::kNear;  // the worst one, with its value there
  double value = 0.0;
  ComfortLevel level = ComfortLevel::kOk;
  double azimuth = 0.0;    // of the worst point, degrees to the right of the picture's middle
  double elevation = 0.0;  // degrees
  double distance = 0.0;   // metres from the circle's centre
  double share = 0.0;      // of what the picture shows, by solid angle: where this thing is not ok
  double enough = 0.0;     // the distance, in the same direction, from which on it is no more than a caution
  float ipd = 0.0f;        // the largest of the picture with which it is no more than a caution, at its distance
};

struct ComfortReport {
  std::array<double, 4> share{};   // of what the picture shows and is known, by solid angle, at each ComfortLevel
  std::array<double, 4> looked{};  // likewise, weighted by where people look: looked_at()
  std::array<double, std::size(kStrains)> most{};  // of each Strain
  std::vector<StrainedPlace> places;               // worst first
  double nearest = 0.0;                            // metres; infinite if there is nothing
  double unknown = 0.0;                            // share of pixels without a depth
  float largest_ipd = 0.0f;                        // of the picture, with which nothing is more than a caution
  double head_roll = 0.0;  // degrees to which the ears may be out of level before kVertical is a warning anywhere
  Image level;             // 1 channel: the ComfortLevel of each pixel, as a number
};

// Throws Error(kInput) if no pixel has a depth. Precondition: the depth has 1 channel, `things` its size or none.
ComfortReport judge_comfort(const SeenDepth& seen, const ComfortOptions& options = {});

// What one point does to the eyes.
struct PointComfort {
  ComfortLevel level = ComfortLevel::kOk;
  double distance = 0.0;              // metres from the circle's centre; infinite if nothing is there
  double near = 0.0, vertical = 0.0;  // of Strain::kNear and kVertical
};

// Of what an eye's picture shows at uv, which is `depth` along its ray.
PointComfort judge_point(const StereoCamera& camera, int eye, vec2 uv, float depth, const Viewer& viewer = {});

// The worst level of anything.
ComfortLevel worst_level(const ComfortReport& report);

// How far around a direction is from -Z: radians to the right.
double azimuth_of(vec3 direction);

// "23 degrees right, 12 down".
std::string direction_text(double azimuth, double elevation);

}  // namespace ods
