// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The numbers of a camera and the range of each. The command line, sidecars, EXR attributes and the presets of other
// systems all read this one table, so that each takes what the others write.
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

// Of every number of a field, both ends included. Degrees, metres.
struct FieldRange {
  float least = 0.0f;
  float most = 0.0f;
  bool contains(float value) const { return value >= least && value <= most; }  // NaN: no
};
FieldRange range_of(CameraField field);

// Where a camera keeps them: three of a position, one for each pole of a merge, none of an axis that it has not.
std::vector<float*> numbers_of(StereoCamera& camera, CameraField field);

// What is wrong with a camera, in words for a message; empty: nothing. A number out of its range, a merge that ends
// where it starts, an axis without a direction, projection_fault().
std::string camera_fault(const StereoCamera& camera);

// The same angle within the range of angles, if it is not there already. Degrees.
float angle_in_range(double degrees);

}  // namespace ods
