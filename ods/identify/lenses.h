// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the fisheyes of a camera by the rims of their image circles, and decides whether both look ahead or one of them
// back.
#pragma once
#include <string>
#include <vector>

#include "ods/image/image.h"
#include "ods/picture/stored_picture.h"

namespace ods {

// Two fisheyes that share a file.
struct SeenLenses {
  std::vector<FisheyeLens> lenses;  // in pixels of the halves
  bool front_and_back = false;      // the second one looks back (its yaw is 0 all the same, as in FormatHint)
  float alike = 0.0f;               // correlation where both lenses see the same, -1..1; only for front and back
};

// The lenses of two halves, as a display shows them: 1 channel, 0..1. Front and back are aligned where they overlap:
// field of view, roll, and the direction of the second one. Returns nullopt if the halves have no rims.
std::optional<SeenLenses> find_lenses(const Image& first, const Image& second, float fov);

// Returns whether `known` and the name allow lenses. is_open: whether the metadata leave the format open.
bool wants_lenses(const FormatHint& known, const std::string& path, bool is_open);

// Returns `known` with the lenses of a file that was opened as one eye, regardless of its layout, if their circles are
// not inscribed in the eyes' pictures or look ahead and back. Appends the result to `notes`. Precondition:
// wants_lenses().
FormatHint with_lenses(const StoredPicture& whole, const std::string& path, const FormatHint& known,
                       std::vector<std::string>& notes);

}  // namespace ods
