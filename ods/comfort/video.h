// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Judges the strain of a stereo video on its viewer by matching the eyes of some of its frames, and each frame with the
// next: the distances of things, the motion of the viewer, jumps of vergence at cuts. docs/comfort.md has the limits
// and their sources.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/names.h"
#include "ods/base/progress.h"
#include "ods/comfort/judge_picture.h"
#include "ods/comfort/strain.h"
#include "ods/picture/metadata/stereo_format.h"

namespace ods {

// Strains over time, in addition to the strains within a picture.
enum class Ride {
  kApart,         // one eye sees things higher, minutes of arc
  kTurn,          // the viewer is turned about the vertical: degrees a second
  kTilt,          // the viewer is turned about another axis, so that the horizon rolls or nods: degrees a second
  kSpeed,         // metres a second
  kAcceleration,  // metres a second squared
  kCut,           // the jump of vergence at a cut: degrees
};

struct RideRow {
  Ride member;
  std::string_view name;
  std::string_view unit;
  std::string_view title;
  StrainLimits limits;
  std::string_view source;
};
inline constexpr double kNoLimit = 1e300;
inline constexpr RideRow kRideTable[] = {
    {Ride::kApart,
     "apart",
     "minutes of arc",
     "one eye sees things higher",
     {15.0, kFusionLimit, 60.0},
     "as for vertical disparity"},
    {Ride::kTurn,
     "turn",
     "degrees a second",
     "the viewer is turned around",
     {10.0, 30.0, 60.0},
     "So, Lo 1999: turning at 30 sickens; Hu et al. 1989: at 60 most; provisional"},
    {Ride::kTilt,
     "tilt",
     "degrees a second",
     "the horizon rolls",
     {3.0, 10.0, 30.0},
     "So, Lo 1999: roll and pitch sicken as yaw does; provisional"},
    {Ride::kSpeed,
     "speed",
     "metres a second",
     "the viewer is carried fast",
     {3.0, 10.0, kNoLimit},
     "So, Lo, Ho 2001: nausea grows from 3 to 10 metres a second"},
    {Ride::kAcceleration,
     "acceleration",
     "metres a second squared",
     "the viewer's speed changes",
     {0.5, 1.5, kNoLimit},
     "provisional"},
    {Ride::kCut,
     "cut",
     "degrees",
     "eyes must jump in depth at a cut",
     {1.84, 3.05, kNoLimit},
     "Nagata 2002, limits of fusion of 392 people"},
};
static_assert(has_every_member(kRideTable));
inline constexpr auto kRides = members_of(kRideTable);
constexpr const RideRow& ride_row(Ride ride) {
  return row_in(kRideTable, ride);
}

// One judged frame.
struct VideoMoment {
  double seconds = 0.0;
  double matched = 0.0;     // share of the picture
  double nearest = 0.0;     // metres; infinite if there is nothing
  double vergence = 0.0;    // degrees: the maximum; 0 for a rule, which measures no strain
  double vertical = 0.0;    // minutes of arc: the maximum; 0 for a rule
  double middle = 0.0;      // degrees: the median vergence within 30 degrees of the horizon
  bool is_carried = false;  // speed, turn and tilt were measured
  double speed = 0.0, turn = 0.0, tilt = 0.0, acceleration = 0.0;  // as Ride
  std::optional<double> cut;                                       // Ride::kCut of a cut since the last moment
  double cut_at = 0.0;                                             // time of the cut, seconds
  ComfortLevel level = ComfortLevel::kOk;
};

// A strain over a span of time.
struct VideoStrain {
  double from = 0.0, to = 0.0, worst = 0.0;  // seconds
  std::string_view name, title, unit;        // of a Strain or a Ride
  double value = 0.0;
  ComfortLevel level = ComfortLevel::kOk;
  std::optional<StrainedPlace> place;  // position, for a strain in the picture
};

struct VideoComfort {
  ComfortLevel level = ComfortLevel::kOk;  // the worst of the moments
  int frames = 0;                          // of the video; 0: unknown
  double seconds = 0.0;                    // the video's duration; 0: unknown
  double every = 0.0;                      // seconds from one moment to the next; 1 if the duration is unknown
  double precision = 0.0;                  // minutes of arc
  std::vector<VideoMoment> moments;
  std::vector<VideoStrain> strains;  // worst first, at most ten
  JudgedPicture worst;  // the picture with the worst strain within it; only verdict, camera and light are set
  std::vector<std::string> notes;  // for messages
};

struct VideoComfortOptions {
  ComfortOptions comfort;
  FormatHint format;
  int max_moments = 90;  // maximum number of judged frames, at least 1
};

// Judges both eyes of a video's frames. Videos whose layout and projection their metadata leave open are identified by
// their pixels. Throws Error(kInput) as open_media(), open_video() and VideoDecoder do, and if the video has one eye or
// nothing matches; Error(kCancelled).
VideoComfort judge_video(const std::string& path, const VideoComfortOptions& options = {},
                         const Progress& progress = {});

}  // namespace ods
