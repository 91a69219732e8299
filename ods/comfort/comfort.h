// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Measures the strain of the viewer's eyes by each point of a stereo picture with depth. verdict.h sums the
// points up; docs/comfort.md explains the report.
//
// Every pixel of one eye is judged by where that eye shows its point; the other eye shows it as far on the other side.
// Exact for level viewing circles with pole merges of every kind, convergence and necks. Eyes that a head-tilt map
// tilts are judged as if they were level.
#pragma once
#include <limits>
#include <string>
#include <vector>

#include "ods/camera/stereo_camera.h"
#include "ods/comfort/strain.h"
#include "ods/image/image.h"

namespace ods {

enum class ComfortRules {
  kStrain,      // the limits of strain.h
  kGoogle,      // nothing nearer than 0.6 m at the horizon and 3.5 m at the poles, for eyes 65 mm apart
  kSafeSphere,  // nothing nearer than ComfortOptions::safe_radius
};

struct ComfortOptions {
  Viewer viewer;
  ComfortRules rules = ComfortRules::kStrain;
  float safe_radius = 1.0f;  // metres
};

// The distance that each pixel of one eye shows, and the thing if it is known.
struct SeenDepth {
  StereoCamera camera;
  int eye = kLeft;          // kMono: judged as if two eyes saw the same
  Image depth;              // 1 channel, as EyeImage::depth; negative or NaN: unknown
  std::vector<int> things;  // index in `names` for each pixel; negative: nothing. Empty: unknown
  std::vector<std::string> names;
};

// The measurements of one pixel.
struct ComfortPoint {
  bool is_known = false;                                    // in the picture, with a depth or showing empty space
  float solid_angle = 0.0f;                                 // steradians
  double looked = 0.0;                                      // gaze_density() of its elevation
  float distance = std::numeric_limits<float>::infinity();  // metres from the circle's centre
  float vergence = 0.0f;                                    // radians
  EnumArray<Strain, float> strains{};
  ComfortLevel level = ComfortLevel::kOk;
};

struct ComfortPoints {
  std::vector<ComfortPoint> points;  // row by row, as SeenDepth::depth
  double circle = 1.0;               // the largest share of the eye distance at which no point exceeds a caution
  double roll = 0.0;                 // radians: the largest head roll at which kVertical does not exceed a caution
};

// Precondition: the depth has 1 channel, `things` its size or none.
ComfortPoints measure_points(const SeenDepth& seen, const ComfortOptions& options);

// The largest share of the eye distance at which this pixel, one of measure_points(), does not exceed a caution.
double comfortable_circle(const SeenDepth& seen, const ComfortOptions& options, const ComfortPoint& point,
                          size_t pixel);

// The strain that determines the level of a point, and its value divided by the limit of a warning.
struct WorstStrain {
  Strain strain = Strain::kNear;
  double ratio = 0.0;
};
WorstStrain worst_strain(const ComfortPoint& point, const EnumArray<Strain, StrainLimits>& limits);

// The judgement of a single point.
struct PointComfort {
  ComfortLevel level = ComfortLevel::kOk;
  double distance = 0.0;              // metres from the circle's centre; infinite if nothing is there
  double near = 0.0, vertical = 0.0;  // values of Strain::kNear and kVertical
};

// Judges the point that an eye's picture shows at uv, `depth` along its ray.
PointComfort judge_point(const StereoCamera& camera, int eye, vec2 uv, float depth, const Viewer& viewer = {});

// The azimuth of a direction: radians to the right of -Z.
double azimuth_of(vec3 direction);

// The elevation of a direction above the horizon, radians.
double elevation_of(vec3 direction);

}  // namespace ods
