// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The faults that lint finds, and the checks that find them. docs/lint.md explains every fault.
#pragma once
#include <string_view>

#include "ods/base/names.h"

namespace ods {

enum class Fault {
  kEyesSwapped,     // the left eye's picture is the right one's
  kRightOnTop,      // the same in top-bottom files
  kOneEyeTwice,     // both eyes have the same picture
  kMonoAsStereo,    // the two supposed eyes are parts of one picture
  kLayoutMisread,   // both eyes exist, in another layout
  kMirroredCircle,  // stereo right ahead and behind, none at +-45 and +-135 degrees, reversed at +-90
  kTwoCameras,      // stereo right ahead, none at the sides, reversed behind
  kNoPoleMerge,     // full stereo right up to a pole
  kRaggedSeam,      // the picture does not continue from its right edge to its left one
  kWrongAspect,     // the picture's shape is not that of its projection
  kMetadata,        // the file, its name or its sidecar contradicts the pixels
  kVideoLevels,     // too large for a video
  kHeadsetSize,     // too large for a headset, or with sides that videos do not have
  kVerticalOffset,  // one eye's picture is higher than the other's, by the same angle everywhere
  kEyePitched,      // one eye looks up or down against the other
  kEyeRolled,
  kEyeMagnified,
  kEyesDiverge,  // distant points have parallax outwards
  kEyeTinted,    // colours differ, and not only in brightness
  kEyeBrighter,
  kEyeGamma,  // one eye has more contrast
  kEyeBlurred,
  kNotLevel,  // vertical lines are tilted, in both eyes
  kDeadPole,  // a disc without a picture at a pole
  kClipped,   // clipped highlights
  kBlack,     // the picture is black
  kBanding,
  kEyeLate,          // video: one eye is ahead of the other in time
  kCutsDiffer,       // the cuts of a video differ in time between the eyes
  kDuplicateFrames,  // video: a frame repeats the one before
};

enum class Severity {
  kFault,        // looks wrong to every viewer
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
  std::string_view title;  // a short title for users
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
    {Fault::kHeadsetSize, "headset-size", "a size that headsets do not take", Severity::kInformation},
    {Fault::kVerticalOffset, "vertical-offset", "one eye sees everything higher", Severity::kFault},
    {Fault::kEyePitched, "eye-pitched", "one eye is pitched against the other", Severity::kFault},
    {Fault::kEyeRolled, "eye-rolled", "one eye is rolled against the other", Severity::kFault},
    {Fault::kEyeMagnified, "eye-magnified", "one eye's picture is larger", Severity::kFault},
    {Fault::kEyesDiverge, "eyes-diverge", "the eyes must diverge", Severity::kFault},
    {Fault::kEyeTinted, "eye-tinted", "one eye has other colours", Severity::kFault},
    {Fault::kEyeBrighter, "eye-brighter", "one eye is brighter", Severity::kFault},
    {Fault::kEyeGamma, "eye-gamma", "one eye has more contrast", Severity::kFault},
    {Fault::kEyeBlurred, "eye-blurred", "one eye is blurred", Severity::kFault},
    {Fault::kNotLevel, "not-level", "the picture is not level", Severity::kWarning},
    {Fault::kDeadPole, "dead-pole", "a pole without a picture", Severity::kWarning},
    {Fault::kClipped, "clipped", "highlights are clipped", Severity::kWarning},
    {Fault::kBlack, "black", "the picture is black", Severity::kFault},
    {Fault::kBanding, "banding", "gradients show banding", Severity::kWarning},
    {Fault::kEyeLate, "eye-late", "one eye is ahead in time", Severity::kFault},
    {Fault::kCutsDiffer, "cuts-differ", "the eyes are cut at different frames", Severity::kFault},
    {Fault::kDuplicateFrames, "duplicate-frames", "frames are duplicated", Severity::kWarning},
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

// The subjects that lint judges or lists as not judged.
enum class Check {
  kLayout,       // the eyes' arrangement in the file, and that they are at one place
  kTwoEyes,      // two different points of view
  kEyeOrder,     // the order of the eyes
  kCircle,       // a viewing circle, two cameras, or a mirrored circle
  kTopPole,      // stereo at the top pole
  kBottomPole,   // stereo at the bottom pole
  kSeam,         // continuity between the right and the left edge
  kShape,        // width over height
  kMetadata,     // contradictions between file, name and sidecar
  kVideoLevels,  // limits of codecs
  kHeadsets,     // sizes that headsets support
  kAlignment,    // height, pitch, roll and size of one eye against the other
  kConvergence,  // eyes that must diverge
  kColors,       // one eye against the other
  kSharpness,    // one eye against the other
  kHorizon,      // a picture that is not level
  kDeadPoles,    // poles without a picture
  kBlack,        // a black picture
  kHighlights,
  kBanding,
  kEyeTime,     // video: both eyes show the same instant
  kCuts,        // video: both eyes are cut at the same frames
  kDuplicates,  // video: frames that repeat the one before
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
    {Check::kHeadsets, "sizes of headsets"},
    {Check::kAlignment, "height, pitch, roll and size between the eyes"},
    {Check::kConvergence, "whether the eyes diverge"},
    {Check::kColors, "colours between the eyes"},
    {Check::kSharpness, "sharpness between the eyes"},
    {Check::kHorizon, "whether it is level"},
    {Check::kDeadPoles, "whether the poles have a picture"},
    {Check::kBlack, "whether it is black"},
    {Check::kHighlights, "highlights"},
    {Check::kBanding, "banding"},
    {Check::kEyeTime, "time between the eyes"},
    {Check::kCuts, "cuts"},
    {Check::kDuplicates, "duplicate frames"},
};
static_assert(has_every_member(kCheckTable));
constexpr bool is_of_time(Check check) {
  return check == Check::kEyeTime || check == Check::kCuts || check == Check::kDuplicates;
}
inline constexpr auto kChecks = members_of(kCheckTable);
constexpr std::string_view check_name(Check check) {
  return name_in(kCheckTable, check);
}

}  // namespace ods
