// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds what is wrong with a stereo 360 picture, ours or another's, as far as its pixels and its metadata show it.
//
// Nearly all of it follows from one fact of omni-directional stereo: a point at the distance rho from the viewing
// circle's axis appears farther right in the left eye than in the right one, by theta_L - theta_R = 2 asin(r / rho).
// That is never negative, wherever the point is, and there is no difference in height.
// docs/lint.md explains every fault.
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
  kRightOnTop,      // likewise in top-bottom files
  kOneEyeTwice,     // both eyes have the same picture
  kMonoAsStereo,    // what are taken for two eyes are parts of one picture
  kLayoutMisread,   // both eyes are there, in another layout
  kMirroredCircle,  // stereo right ahead and behind, none at +-45 and +-135 degrees, reversed at +-90
  kTwoCameras,      // stereo right ahead, none at the sides, reversed behind
  kNoPoleMerge,     // full stereo right up to a pole
  kRaggedSeam,      // the picture does not continue from its right edge to its left one
  kWrongAspect,     // the picture's shape is not that of its projection
  kMetadata,        // the file, its name or its sidecar contradicts the pixels
  kVideoLevels,     // too large for a video
};

enum class Severity {
  kFault,        // looks wrong to everybody
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
  std::string_view title;  // a few words for users
  Severity severity;
};
inline constexpr FaultRow kFaultTable[] = {
    {Fault::kEyesSwapped, "eyes-swapped", "the eyes are swapped", Severity::kFault},
    {Fault::kRightOnTop, "right-on-top", "the right eye is on top", Severity::kFault},
    {Fault::kOneEyeTwice, "one-eye-twice", "both eyes see the same picture", Severity::kFault},
    {Fault::kMonoAsStereo, "mono-as-stereo", "one picture is taken for two eyes", Severity::kFault},
    {Fault::kLayoutMisread, "layout-misread", "the layout is not what it claims", Severity::kFault},
    {Fault::kMirroredCircle, "mirrored-circle", "the eyes' circle is mirrored", Severity::kFault},
    {Fault::kTwoCameras, "two-cameras", "two fixed cameras in place of a circle", Severity::kFault},
    {Fault::kNoPoleMerge, "no-pole-merge", "full stereo at a pole", Severity::kWarning},
    {Fault::kRaggedSeam, "ragged-seam", "the seam shows", Severity::kFault},
    {Fault::kWrongAspect, "wrong-aspect", "the shape does not fit", Severity::kFault},
    {Fault::kMetadata, "metadata", "the metadata contradicts the pixels", Severity::kFault},
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
  double certainty = 0.0;  // 0..1, from measurements
  std::string evidence;    // includes numbers
  std::string cure;
};

// What lint judges, or names as not judged.
enum class Check {
  kLayout,       // how the eyes share the file, and whether they are at one place
  kTwoEyes,      // whether they see from two points
  kEyeOrder,     // which eye is which
  kCircle,       // a viewing circle, two cameras, or a mirrored circle
  kTopPole,      // stereo at the top pole
  kBottomPole,   // stereo at the bottom pole
  kSeam,         // where the right edge meets the left one
  kShape,        // width over height
  kMetadata,     // the statements of file, name and sidecar
  kVideoLevels,  // of codecs
  kBetweenEyes,  // height, roll, colour and sharpness; lint does not measure them
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
  std::optional<Layout> layout;                 // none: that of guess_layout()
  std::optional<ProjectionSetting> projection;  // none: that of the file, its sidecar or its name, else lat-long
};

struct LintReport {
  Extent file;  // size of the file, or of either file of a pair
  Extent eye;   // as stored
  int eye_count = 1;
  std::optional<Layout> layout;  // the layout that the file was read in; none: one eye
  std::string reason;
  std::string projection;
  std::vector<Finding> findings;  // the most certain first; includes findings whose certainty is nearly 0
  std::vector<Check> judged;      // every check is either here or in not_judged
  std::vector<NotJudged> not_judged;
  std::vector<std::string> notes;  // what was ignored in the file: NaN, a colour profile
};

// Whether there is a finding at least this severe and this certain.
bool has_finding(const LintReport& report, Severity severity, double certainty);

// A path with %V or %v names two files. Throws Error(kInput) as load_eyes() does.
LintReport lint(const std::string& path, const LintOptions& options = {});

}  // namespace ods
