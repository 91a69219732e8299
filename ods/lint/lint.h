// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What is wrong with a stereo 360 picture, ours or another's, as far as its pixels and its own words tell.
//
// Nearly all of it follows from one fact of omni-directional stereo: a point at the distance rho from the viewing
// circle's axis stands theta_L - theta_R = 2 asin(r / rho) farther right in the left eye than in the right one. That is
// never negative, wherever the point is, and there is no difference in height. docs/lint.md explains every fault.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ods/camera/layout.h"
#include "ods/camera/projection.h"

namespace ods {

enum class Fault {
  kEyesSwapped,     // the left eye's picture is the right one's
  kRightOnTop,      // the same of top-bottom files
  kOneEyeTwice,     // both eyes see one picture
  kMonoAsStereo,    // what are said to be two eyes are parts of one
  kLayoutMisread,   // the eyes are there, in another layout
  kMirroredCircle,  // stereo right ahead and behind, none at +-45 and +-135 degrees, reversed at +-90
  kTwoCameras,      // stereo right ahead, none at the sides, reversed behind
  kNoPoleMerge,     // full stereo right up to a pole
  kRaggedSeam,      // the picture does not go on from its right edge to its left one
  kWrongAspect,     // its shape is not its projection's
  kMetadata,        // what the file, its name or its sidecar says is not what it holds
  kVideoLevels,     // too large for a video
};

inline constexpr Fault kFaults[] = {Fault::kEyesSwapped,  Fault::kRightOnTop,    Fault::kOneEyeTwice,
                                    Fault::kMonoAsStereo, Fault::kLayoutMisread, Fault::kMirroredCircle,
                                    Fault::kTwoCameras,   Fault::kNoPoleMerge,   Fault::kRaggedSeam,
                                    Fault::kWrongAspect,  Fault::kMetadata,      Fault::kVideoLevels};
std::string_view fault_name(Fault fault);   // eyes-swapped, right-on-top, ...
std::string_view fault_title(Fault fault);  // a few words for people

enum class Severity {
  kFault,        // looks wrong, to everybody
  kWarning,      // looks wrong in places, or is a matter of taste
  kInformation,  // good to know
};
Severity severity_of(Fault fault);
std::string_view severity_name(Severity severity);  // fault, warning, information

struct Finding {
  Fault fault = Fault::kEyesSwapped;
  double certainty = 0.0;  // 0..1, from what was measured
  std::string evidence;    // with numbers
  std::string cure;
};

// What is judged, or would have to be.
enum class Check {
  kLayout,       // how the eyes share the file, and whether they see one place
  kTwoEyes,      // whether they see it from two places
  kEyeOrder,     // which eye is which
  kCircle,       // a circle of eyes, or two cameras, or a mirrored circle
  kTopPole,      // stereo there
  kBottomPole,   // likewise
  kSeam,         // where the right edge meets the left one
  kShape,        // width over height
  kMetadata,     // what file, name and sidecar say
  kVideoLevels,  // of codecs
  kBetweenEyes,  // height, roll, colour and sharpness: nothing here measures them
};

inline constexpr Check kChecks[] = {Check::kLayout,   Check::kTwoEyes,     Check::kEyeOrder,   Check::kCircle,
                                    Check::kTopPole,  Check::kBottomPole,  Check::kSeam,       Check::kShape,
                                    Check::kMetadata, Check::kVideoLevels, Check::kBetweenEyes};
std::string_view check_name(Check check);  // in words: "which eye is which"

struct NotJudged {
  Check check = Check::kLayout;
  std::string reason;  // "not enough detail"
};

struct LintOptions {
  std::optional<Layout> layout;                 // none: as guess_layout() has it
  std::optional<ProjectionSetting> projection;  // none: what the file, its sidecar or its name say, else lat-long
};

struct LintReport {
  Extent file;  // of either file of a pair
  Extent eye;   // as it is stored
  int eye_count = 1;
  std::optional<Layout> layout;  // as it was read; none: one eye
  std::string reason;
  std::string projection;
  std::vector<Finding> findings;  // the surest first; also what is next to certainly not so
  std::vector<Check> judged;      // every check is here or among those that could not be made
  std::vector<NotJudged> not_judged;
  std::vector<std::string> notes;  // what of the file was left aside: NaN, a colour profile
};

// The findings at least as sure as this and as severe.
bool has_finding(const LintReport& report, Severity severity, double certainty);

// %V or %v in the path stands for two files. Throws Error(kInput) as load_eyes() does.
LintReport lint(const std::string& path, const LintOptions& options = {});

}  // namespace ods
