// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The layouts, projections and tone curves that the viewer's page can choose for a picture, as a module of constants.
#pragma once
#include <array>
#include <string>

#include "ods/camera/layout.h"

namespace ods {

// Returns the place of an eye in a file with `eye_count` eyes: the fractions at which it begins, x and y, and its size.
std::array<double, 4> eye_part(Layout layout, int eye_count, int index);

// Returns formats.js, a module that web/ imports:
//   LAYOUTS = [{name, left, right}], eyes as eye_part(); PROJECTIONS = [{name, summary, camera}], cameras as
//   camera_json(); TONES = [name].
std::string formats_module();

}  // namespace ods
