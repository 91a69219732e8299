// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the faults of a stereo 360 picture, from our renderer or any other, in its pixels and its metadata.
//
// Nearly all checks follow from one fact of omni-directional stereo: a point at the distance rho from the viewing
// circle's axis appears farther right in the left eye than in the right one, by theta_L - theta_R = 2 asin(r / rho).
// The difference is never negative, for any point, and the heights are equal.
// docs/lint.md explains every fault.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/camera/direction_map.h"
#include "ods/camera/layout.h"
#include "ods/camera/projection.h"
#include "ods/lint/faults.h"

namespace ods {

struct Finding {
  Fault fault = Fault::kEyesSwapped;
  double certainty = 0.0;  // 0..1, from measurements
  std::string evidence;    // includes numbers
  std::string remedy;
  std::vector<double> times{};  // times of a video's frames that show it, seconds; empty for all frames or a picture
};

struct NotJudged {
  Check check = Check::kLayout;
  std::string reason;  // "not enough detail"
};

struct LintOptions {
  std::optional<Layout> layout;                 // find_format() if not set
  std::optional<ProjectionSetting> projection;  // if not set, from the file, its sidecar or its name, else lat-long
  std::vector<FisheyeLens> lenses{};            // as in FormatHint; the eyes are then judged as they are when unwrapped
};

struct LintReport {
  Extent file;  // size of the file, or of each file of a pair
  Extent eye;   // as stored
  int eye_count = 1;
  std::optional<Layout> layout;  // the layout that the file was read in; not set for one eye
  std::string reason;
  std::string projection;
  std::vector<Finding> findings;  // the most certain first; includes findings whose certainty is nearly 0
  std::vector<Check> judged;      // every check is either here or in not_judged
  std::vector<NotJudged> not_judged;
  int frames = 0;                  // number of frames of a video
  int judged_frames = 0;           // number of a video's frames judged as pictures
  std::vector<std::string> notes;  // things ignored in the file: NaN, a colour profile
};

// Returns whether there is a finding at least this severe and this certain.
bool has_finding(const LintReport& report, Severity severity, double certainty);

// A path with %V or %v names two files. Throws Error(kInput) as load_eyes() does.
LintReport lint(const std::string& path, const LintOptions& options = {});

}  // namespace ods
