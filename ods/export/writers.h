// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Code shared by the writers of camera_export.h.
#pragma once
#include <array>

#include "ods/export/camera_export.h"
#include "ods/export/camera_formula.h"

namespace ods {

// The abilities of a system with its own camera.
struct Abilities {
  std::string_view system;
  bool tilt = false;  // pitch and roll, which tilt the viewing circle too
  bool neck = false;
  bool toe_in = false;
  bool partial = false;  // part of a lat-long picture
};

// The requirements of a camera that the abilities lack, one phrase each. The caller handles merges, projections other
// than lat-long, and layouts. None of these systems supports another axis, a rotated picture, a mirrored world or a
// lens like ours.
std::vector<std::string> lacking(const Sidecar& file, const Abilities& abilities);

bool is_plain_cosine(const PoleMergeSetting& merge);   // exponent 1, up to the pole
std::string one_merge(const PoleMergeSetting& merge);  // "cosine from 60 to 90 degrees"
std::string merge_text(const StereoCamera& camera);    // for both poles
std::string camera_title(const Sidecar& file);         // "both eyes, top-bottom, lat-long"
Extent picture_size(const Sidecar& file);              // size of the whole file; 0x0 if unknown
std::string yaw_pitch_roll(const StereoCamera& camera);

// Comment lines: a title, and the features that the target lacks.
std::string comment_block(const std::string& mark, const std::string& title, const std::vector<std::string>& warnings);

// The camera's pose in a right-handed world with +Y up: right, up, back and position.
std::array<glm::dvec3, 4> placement(const StereoCamera& camera);

CameraExport to_povray(const Sidecar& file);
CameraExport to_povray_fork(const Sidecar& file);
CameraExport to_blender(const Sidecar& file);
CameraExport to_osl(const Sidecar& file);
CameraExport to_arnold(const Sidecar& file);
CameraExport to_mtoa(const Sidecar& file);
CameraExport to_glsl(const Sidecar& file);
CameraExport to_hlsl(const Sidecar& file);
CameraExport to_python(const Sidecar& file);
CameraExport to_numbers(const Sidecar& file);

}  // namespace ods
