// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A camera's own fisheyes: found by the rims of their circles, and whether both look ahead or one of them back.
#pragma once
#include <string>
#include <vector>

#include "ods/image/image.h"
#include "ods/picture/metadata/stereo_format.h"

namespace ods {

// Two fisheyes that share a file.
struct SeenLenses {
  std::vector<FisheyeLens> lenses;  // in pixels of the halves
  bool front_and_back = false;      // the second one looks back (its yaw is 0 all the same, as in FormatHint)
  float alike = 0.0f;               // how well they agree where both see, -1..1; of front and back only
};

// The lenses of two halves, as a display shows them: 1 channel, 0..1. Front and back are aligned where they overlap:
// field of view, roll, and where the second one points. Nothing if the halves have no rims.
std::optional<SeenLenses> find_lenses(const Image& first, const Image& second, float fov);

// `known` with the lenses of the file, where it says fisheye, or nothing, and has circles that are not inscribed in the
// eyes' pictures, or that look ahead and back. `notes` gets what was found. Throws Error(kInput) as open_picture().
FormatHint with_lenses(const std::string& path, const FormatHint& known, std::vector<std::string>& notes);

}  // namespace ods
