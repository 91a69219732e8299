// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// All parameters of a camera, and their names in files and commands. Sidecars, EXR attributes, the command line, the
// settings of an interrupted render, the metadata of rigs and the presets of other systems all read these two tables,
// so each accepts what the others write. The name of the projection, the two maps and `mirrored` are in neither table.
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
  float minimum = 0.0f;
  float maximum = 0.0f;
  bool contains(float value) const { return value >= minimum && value <= maximum; }  // false for NaN
};

struct CameraFieldRow {
  CameraField member;
  std::string_view name;  // for users: "yaw"
  FieldRange range;
  std::string_view unit;       // "degrees"; empty for a plain number
  std::string_view setting;    // the setting that it belongs to, an option of the command: "lens-direction"
  std::string_view place;      // its key in a sidecar: "projection.pan"
  std::string_view attribute;  // in an EXR header: "ods:look"; a # at the end stands for one attribute per number
  std::vector<float*> (*numbers)(StereoCamera& camera);
  bool (*matters)(const StereoCamera& camera);  // returns whether another value would change the picture
  std::string_view help = {};  // for options with one number of the viewing circle, such as --ipd; else empty
};
std::span<const CameraFieldRow> camera_fields();
const CameraFieldRow& row_of(CameraField field);
FieldRange range_of(CameraField field);

// The numbers of a field: three for a position; none if the camera does not have the field, for example an axis of its
// own or a polynomial.
std::vector<float*> numbers_of(StereoCamera& camera, CameraField field);
std::vector<float> values_of(const StereoCamera& camera, const CameraFieldRow& row);

// A mode, one of several names.
struct CameraModeRow {
  std::string_view setting;  // as in CameraFieldRow
  std::string_view place;
  std::string_view attribute;
  std::span<const NameRow<int>> names;
  int& (*value)(StereoCamera& camera);
  bool (*matters)(const StereoCamera& camera);
};
std::span<const CameraModeRow> camera_modes();
std::string_view mode_of(const StereoCamera& camera, const CameraModeRow& row);

// All parameters of a camera as text, always the same settings in the same order: "merge-top" is "cosine,60,90,1".
// Numbers and names are given only where they matter, so "axis" is empty for a camera without an axis of its own.
struct CameraSetting {
  std::string_view name;
  std::string value;
};
std::vector<CameraSetting> camera_settings(const StereoCamera& camera);

// Describes the fault of a camera, for messages. Empty if it has none. Checks for numbers out of range, a merge that
// ends where it starts, an axis without a direction, and projection_fault().
std::string camera_fault(const StereoCamera& camera);

// The same angle in degrees, moved into the range of angles if it is outside.
float angle_in_range(double degrees);

}  // namespace ods
