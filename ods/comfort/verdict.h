// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The verdict on a stereo picture, for all its eyes, by one rule. Reports, exit codes, the viewer's layer and warnings
// before rendering all read it. judge_picture.h judges a file, ods/stage/judge_scene.h a scene, video.h
// each moment of a video.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ods/comfort/comfort.h"

namespace ods {

// A thing that strains, or an area if things have no names.
struct StrainedPlace {
  std::string name;
  Strain strain = Strain::kNear;  // the worst one, with its value there
  double value = 0.0;
  ComfortLevel level = ComfortLevel::kOk;
  size_t eye = 0;          // eye with the worst point: index in ComfortVerdict::per_eye
  double azimuth = 0.0;    // of the worst point in the camera's own frame, degrees to the right, -180..180
  double elevation = 0.0;  // degrees
  double distance = 0.0;   // metres from the circle's centre
  double share = 0.0;      // of the picture, by solid angle: the part of this thing that is not ok
  double enough = 0.0;     // metres from the circle's centre: there and beyond, its worst point is at most a
                           // caution; infinite if no distance is known
  float ipd = 0.0f;        // metres: the largest eye distance at which it is at most a caution; meaningless for kRule
};

struct EyeComfort {
  int eye = kLeft;
  ComfortLevel level = ComfortLevel::kOk;  // the worst of its pixels
  Image levels;                            // 1 channel: the ComfortLevel of each pixel, as a number
};

// The quality of the matching of the eyes of a picture without depth.
struct MatchQuality {
  double share = 0.0;      // matched fraction of the picture, by solid angle
  double precision = 0.0;  // precision of the parallax, minutes of arc
  // The largest difference in height between the eyes within 30 degrees of the horizon, minutes of arc: a raise, pitch,
  // roll or zoom of one eye's picture.
  double apart = 0.0;
};

// All numbers are for all eyes together: shares of all their pixels, the largest strain and the nearest thing of any
// eye.
struct ComfortVerdict {
  ComfortLevel level = ComfortLevel::kOk;  // the worst of the eyes and of `apart`
  std::vector<EyeComfort> per_eye;
  std::optional<MatchQuality> match;         // set for a picture without depth
  ComfortLevel apart = ComfortLevel::kOk;    // the level of match->apart
  EnumArray<ComfortLevel, double> share{};   // 0..1 of the known part, by solid angle
  EnumArray<ComfortLevel, double> looked{};  // the share weighted by where people look: gaze_density()
  EnumArray<Strain, double> max{};           // largest value of each strain
  std::vector<StrainedPlace> places;         // worst first, at most ten
  double nearest = 0.0;                      // metres; infinite if there is nothing
  double unknown = 0.0;                      // 0..1 of the pixels, not by solid angle: without a depth
  float largest_ipd =
      0.0f;  // metres, at most the camera's: the largest at which nothing exceeds a caution; meaningless for a
             // rule
  double head_roll = 0.0;  // degrees that the ears may be out of level before kVertical is a warning anywhere. 0: it
                           // is one with level ears; 90: no limit

  // The worst place; nullptr if nothing strains.
  const StrainedPlace* worst() const { return places.empty() ? nullptr : &places[0]; }
};

// Judges the eyes of one picture. Throws Error(kInput) if no pixel has a depth. Preconditions: as for measure_points();
// there is an eye; all have the same camera, and the same names or none.
ComfortVerdict judge_comfort(std::span<const SeenDepth> eyes, const ComfortOptions& options = {},
                             const std::optional<MatchQuality>& match = {});
ComfortVerdict judge_comfort(const SeenDepth& eye, const ComfortOptions& options = {});

// "23 degrees right, 12 down".
std::string direction_text(double azimuth, double elevation);

// The remedy of a place by its distance: "move it at least 0.75 m away". Empty if it is at most a caution.
std::string remedy_by_distance(const StrainedPlace& place);

// The worst place and its remedy in a line, for messages; empty if it is below this level: "'Lamp', 0.41 m away, 23
// degrees right, 12 down, strains the viewer's eyes: ...; move it at least 0.75 m away".
std::string strain_line(const ComfortVerdict& verdict, ComfortLevel level);

}  // namespace ods
