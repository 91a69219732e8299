// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The cameras of other systems, with the parameters familiar to their users.
#pragma once
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ods/camera/stereo_camera.h"

namespace ods {

struct PresetParameter {
  std::string_view name;
  std::string_view value;    // the system's default, lengths in metres
  std::string_view meaning;  // the meaning of the parameter, or the values that it accepts
};

struct CameraPreset {
  std::string_view name;
  std::string_view system;
  bool exact;             // the rays are identical; otherwise they are close, and the note names the differences
  std::string_view note;  // includes the source of the formula
  std::span<const PresetParameter> parameters;
};

std::span<const CameraPreset> camera_presets();
const CameraPreset* find_camera_preset(std::string_view name);

// The camera with the system's rays for these parameters; parameters that are not given have the system's defaults.
// Position and orientation are not changed, except that a system's rotation angle becomes the camera's yaw.
// Throws std::invalid_argument with a line to show, if the system has no such parameter or a value is not a number.
StereoCamera camera_like(const CameraPreset& preset, const std::map<std::string, std::string>& given);

}  // namespace ods
