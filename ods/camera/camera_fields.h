// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Everything that a camera says, and the names that it has in files and commands. Sidecars, EXR attributes, the command
// line, the settings of an interrupted render, the marks of rigs and the presets of other systems all read these two
// tables, so each accepts what the others write. The projection's name, the two maps and `mirrored` are in neither.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/names.h"
#include "ods/camera/stereo_camera.h"

namespace ods {

enum class CameraField {
  kLongitude,
  kLatitude,
  kFov,
  kAspect,
  kPan,
  kTilt,
  kSensor,
  kPolynomial,
  kPosition,
  kYaw,
  kPitch,
  kRoll,
  kIpd,
  kNeck,
  kTopMergeStart,
  kTopMergeEnd,
  kTopMergeExponent,
  kBottomMergeStart,
  kBottomMergeEnd,
  kBottomMergeExponent,
  kConvergenceDistance,
  kAxis,
  kLensRadius,
  kFocusDistance,
};

// The range of every number of a field, both ends included.
struct FieldRange {
  float least = 0.0f;
  float most = 0.0f;
  bool contains(float value) const { return value >= least && value <= most; }  // NaN: no
};

struct CameraFieldRow {
  CameraField member;
  std::string_view name;  // for people: "yaw"
  FieldRange range;
  std::string_view unit;       // "degrees"; empty: a plain number
  std::string_view setting;    // the setting that it is part of, an option of the command: "lens-direction"
  std::string_view place;      // its key in a sidecar: "projection.pan"
  std::string_view attribute;  // its attribute in an EXR header: "ods:look"; where it ends in #, one for each number
  std::vector<float*> (*numbers)(StereoCamera& camera);
  bool (*matters)(const StereoCamera& camera);  // whether another number would make another picture
  std::string_view help = {};  // of an option that is one number of the viewing circle, such as --ipd; empty: any other
};
std::span<const CameraFieldRow> camera_fields();
const CameraFieldRow& row_of(CameraField field);
FieldRange range_of(CameraField field);

// The places where a camera keeps a field's numbers: three of a position; none if the camera has no such thing, as an
// axis of its own or a polynomial.
std::vector<float*> numbers_of(StereoCamera& camera, CameraField field);
std::vector<float> values_of(const StereoCamera& camera, const CameraFieldRow& row);

// A mode, one of several names.
struct CameraModeRow {
  std::string_view setting;  // as CameraFieldRow has them
  std::string_view place;
  std::string_view attribute;
  std::span<const NameRow<int>> names;
  int& (*value)(StereoCamera& camera);
  bool (*matters)(const StereoCamera& camera);
};
std::span<const CameraModeRow> camera_modes();
std::string_view mode_of(const StereoCamera& camera, const CameraModeRow& row);

// What a camera says, always the same settings in the same order: "merge-top" is "cosine,60,90,1". Numbers and names
// appear only where they matter, so "axis" is empty for a camera without an axis of its own.
struct CameraSetting {
  std::string_view name;
  std::string value;
};
std::vector<CameraSetting> camera_settings(const StereoCamera& camera);

// What is wrong with a camera, in words for a message; empty: nothing. Checks for a number out of its range, a merge
// that ends where it starts, an axis without a direction, and projection_fault().
std::string camera_fault(const StereoCamera& camera);

// The same angle, moved into the range of angles if it is outside. Degrees.
float angle_in_range(double degrees);

}  // namespace ods
