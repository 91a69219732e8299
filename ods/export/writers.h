// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What the writers of camera_export.h share.
#pragma once
#include <array>

#include "ods/export/camera_export.h"
#include "ods/export/camera_formula.h"

namespace ods {

// What a system with a camera of its own can do.
struct Abilities {
  std::string_view system;
  bool tilt = false;  // pitch and roll, the viewing circle with them
  bool neck = false;
  bool toe_in = false;
  bool partial = false;  // parts of a lat-long
};

// What a camera has and the abilities do not, a phrase each. Merges, projections other than lat-long and layouts are left
// to the caller. None of these systems knows another axis, a turned picture, a mirrored world or our lens.
std::vector<std::string> lacking(const Sidecar& file, const Abilities& abilities);

bool is_plain_cosine(const PoleMergeSetting& merge);   // exponent 1, up to the pole
std::string one_merge(const PoleMergeSetting& merge);  // "cosine from 60 to 90 degrees"
std::string merge_text(const StereoCamera& camera);    // of both poles
std::string camera_title(const Sidecar& file);         // "both eyes, top-bottom, lat-long"
Extent picture_size(const Sidecar& file);              // of the whole file; 0x0 when not known
std::string yaw_pitch_roll(const StereoCamera& camera);

// Lines of comment: a title, and what the target lacks.
std::string comment_block(const std::string& mark, const std::string& title, const std::vector<std::string>& warnings);

// The camera's place in a right-handed world with +Y up: its right, up, back and position.
std::array<glm::dvec3, 4> placement(const StereoCamera& camera);

CameraExport to_povray(const Sidecar& file);
CameraExport to_povray_fork(const Sidecar& file);
CameraExport to_blender(const Sidecar& file);
CameraExport to_osl(const Sidecar& file);
CameraExport to_ospray(const Sidecar& file);
CameraExport to_arnold(const Sidecar& file);
CameraExport to_mtoa(const Sidecar& file);
CameraExport to_unity(const Sidecar& file);
CameraExport to_unreal(const Sidecar& file);
CameraExport to_glsl(const Sidecar& file);
CameraExport to_hlsl(const Sidecar& file);
CameraExport to_python(const Sidecar& file);
CameraExport to_numbers(const Sidecar& file);

}  // namespace ods
