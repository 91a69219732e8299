// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The numbers of a camera and the range of each. The command line, sidecars, EXR attributes and the presets of other
// systems all use this one table, so each accepts what the others write.
#pragma once
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/names.h"
#include "ods/camera/stereo_camera.h"

namespace ods {

enum class CameraField {
  kPosition,
  kYaw,
  kPitch,
  kRoll,
  kIpd,
  kNeck,
  kMergeStart,
  kMergeEnd,
  kMergeExponent,
  kConvergenceDistance,
  kAxis,
  kLensRadius,
  kFocusDistance,
  kLongitude,
  kLatitude,
  kFov,
  kAspect,
  kPan,
  kTilt,
  kSensor,
  kPolynomial,
};

inline constexpr CameraField kCameraFields[] = {CameraField::kPosition,      CameraField::kYaw,
                                                CameraField::kPitch,         CameraField::kRoll,
                                                CameraField::kIpd,           CameraField::kNeck,
                                                CameraField::kMergeStart,    CameraField::kMergeEnd,
                                                CameraField::kMergeExponent, CameraField::kConvergenceDistance,
                                                CameraField::kAxis,          CameraField::kLensRadius,
                                                CameraField::kFocusDistance, CameraField::kLongitude,
                                                CameraField::kLatitude,      CameraField::kFov,
                                                CameraField::kAspect,        CameraField::kPan,
                                                CameraField::kTilt,          CameraField::kSensor,
                                                CameraField::kPolynomial};
static_assert(std::size(kCameraFields) == enumerator_count<CameraField>());
std::string_view field_name(CameraField field);  // for people: "yaw"

// The range of every number of a field, both ends included. Degrees, metres.
struct FieldRange {
  float least = 0.0f;
  float most = 0.0f;
  bool contains(float value) const { return value >= least && value <= most; }  // NaN: no
};
FieldRange range_of(CameraField field);

// The places where a camera keeps a field's numbers: three of a position, one for each pole of a merge, none if the
// camera has no axis.
std::vector<float*> numbers_of(StereoCamera& camera, CameraField field);

// What is wrong with a camera, in words for a message; empty: nothing. Checks for a number out of its range, a merge
// that ends where it starts, an axis without a direction, and projection_fault().
std::string camera_fault(const StereoCamera& camera);

// The same angle, moved into the range of angles if it is outside. Degrees.
float angle_in_range(double degrees);

}  // namespace ods
