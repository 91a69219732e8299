// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Dialects: the cameras of other systems, by the parameters that their users know.
#pragma once
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ods/camera/camera_rig.h"

namespace ods {

struct DialectParameter {
  std::string_view name;
  std::string_view value;    // where it starts: the system's default, lengths in metres
  std::string_view meaning;  // of it, or the words it may be
};

struct Dialect {
  std::string_view name;
  std::string_view system;
  bool exact;             // the same rays; else close to them, and the note says what differs
  std::string_view note;  // with the source of the formula
  std::span<const DialectParameter> parameters;
};

std::span<const Dialect> dialects();
const Dialect* find_dialect(std::string_view name);

// The rig that sees as the system does with these parameters; those not given stand at its defaults. Position and
// attitude stay the rig's own, but for a system's angle of rotation, which becomes its yaw.
// Throws std::invalid_argument with a line to show: a parameter that the system has not, a value that is no number.
CameraRig rig_like(const Dialect& dialect, const std::map<std::string, std::string>& given);

}  // namespace ods
