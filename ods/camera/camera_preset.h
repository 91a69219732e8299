// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The cameras of other systems, by the parameters that their users know.
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
  std::string_view value;    // where it starts: the system's default, lengths in metres
  std::string_view meaning;  // of it, or the words it may be
};

struct CameraPreset {
  std::string_view name;
  std::string_view system;
  bool exact;             // the same rays; else close to them, and the note says what differs
  std::string_view note;  // with the source of the formula
  std::span<const PresetParameter> parameters;
};

std::span<const CameraPreset> camera_presets();
const CameraPreset* find_camera_preset(std::string_view name);

// The camera that sees as the system does with these parameters; those not given have its defaults. Position and
// orientation stay the camera's own, but for a system's angle of rotation, which becomes its yaw.
// Throws std::invalid_argument with a line to show: a parameter that the system has not, a value that is no number.
StereoCamera camera_like(const CameraPreset& preset, const std::map<std::string, std::string>& given);

}  // namespace ods
