// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// An option for a number of a camera, with the camera's range for it.
#pragma once
#include <string>

#include "cli/console/options.h"
#include "ods/camera/camera_fields.h"

// T: float or std::optional<float>.
template <class T>
void add_field_option(Options& options, const std::string& name, T& value, ods::CameraField field,
                      const std::string& text) {
  const ods::FieldRange range = range_of(field);
  options.number(name, value, range.minimum, range.maximum, text);
}
