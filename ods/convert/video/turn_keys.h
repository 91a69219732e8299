// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The rotation of a camera during filming, as keyframes in a text file, so that `ods convert` can turn its video back.
//
// A line is a keyframe: "TIME ROLL" or "TIME YAW PITCH ROLL". The time is in seconds, 1:02.5 or 1:02:03; angles are in
// degrees: yaw to the right, pitch up, roll clockwise. Times ascend. Empty lines, and text after #, are ignored.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ods/camera/stereo_camera.h"

namespace ods {

struct TurnKey {
  double seconds = 0.0;
  ViewAngles turned{0.0f, 0.0f, 0.0f};
};

// Reads keyframes. Throws Error(kInput) for an unreadable file, no keyframe, or a line of another form.
std::vector<TurnKey> read_turn_keys(const std::string& path);

// The angles at a time, interpolated linearly between keyframes, constant before the first and after the last.
// Precondition: there is a keyframe.
ViewAngles turned_at(const std::vector<TurnKey>& keys, double seconds);

// Parses "12.5", "1:02.5" or "1:02:03" to seconds. Returns nullopt for other texts.
std::optional<double> parse_time(std::string_view text);

}  // namespace ods
