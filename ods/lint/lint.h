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

#include "ods/base/names.h"
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

enum class Severity {
  kFault,        // looks wrong, to everybody
  kWarning,      // looks wrong in places, or is a matter of taste
  kInformation,  // good to know
};
inline constexpr NameRow<Severity> kSeverityTable[] = {
    {Severity::kFault, "fault"},
    {Severity::kWarning, "warning"},
    {Severity::kInformation, "information"},
};
static_assert(has_every_member(kSeverityTable));
constexpr std::string_view severity_name(Severity severity) {
  return name_in(kSeverityTable, severity);
}

struct FaultRow {
  Fault member;
  std::string_view name;
  std::string_view title;  // a few words for people
  Severity severity;
};
inline constexpr FaultRow kFaultTable[] = {
    {Fault::kEyesSwapped, "eyes-swapped", "the eyes are swapped", Severity::kFault},
    {Fault::kRightOnTop, "right-on-top", "the right eye is on top", Severity::kFault},
    {Fault::kOneEyeTwice, "one-eye-twice", "both eyes see the same picture", Severity::kFault},
    {Fault::kMonoAsStereo, "mono-as-stereo", "one picture is taken for two eyes", Severity::kFault},
    {Fault::kLayoutMisread, "layout-misread", "the eyes lie otherwise in the file", Severity::kFault},
    {Fault::kMirroredCircle, "mirrored-circle", "the eyes' circle is mirrored", Severity::kFault},
    {Fault::kTwoCameras, "two-cameras", "two fixed cameras in place of a circle", Severity::kFault},
    {Fault::kNoPoleMerge, "no-pole-merge", "full stereo at a pole", Severity::kWarning},
    {Fault::kRaggedSeam, "ragged-seam", "the seam shows", Severity::kFault},
    {Fault::kWrongAspect, "wrong-aspect", "the shape does not fit", Severity::kFault},
    {Fault::kMetadata, "metadata", "its words do not fit its pixels", Severity::kFault},
    {Fault::kVideoLevels, "video-levels", "too large for videos", Severity::kInformation},
};
static_assert(has_every_member(kFaultTable));
inline constexpr auto kFaults = members_of(kFaultTable);
constexpr std::string_view fault_name(Fault fault) {
  return name_in(kFaultTable, fault);
}
constexpr std::string_view fault_title(Fault fault) {
  return row_in(kFaultTable, fault).title;
}
constexpr Severity severity_of(Fault fault) {
  return row_in(kFaultTable, fault).severity;
}

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

inline constexpr NameRow<Check> kCheckTable[] = {
    {Check::kLayout, "the layout of the eyes"},
    {Check::kTwoEyes, "whether the eyes see from two places"},
    {Check::kEyeOrder, "which eye is which"},
    {Check::kCircle, "a circle of eyes or two cameras"},
    {Check::kTopPole, "stereo at the top pole"},
    {Check::kBottomPole, "stereo at the bottom pole"},
    {Check::kSeam, "the seam"},
    {Check::kShape, "the shape"},
    {Check::kMetadata, "metadata"},
    {Check::kVideoLevels, "video levels"},
    {Check::kBetweenEyes, "height, roll, colour and sharpness between the eyes"},
};
static_assert(has_every_member(kCheckTable));
inline constexpr auto kChecks = members_of(kCheckTable);
constexpr std::string_view check_name(Check check) {
  return name_in(kCheckTable, check);
}

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
