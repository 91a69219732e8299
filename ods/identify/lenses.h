// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the fisheyes of a camera by the rims of their image circles, and decides whether both look ahead or one of them
// back.
#pragma once
#include <string>
#include <vector>

#include "ods/identify/front_and_back.h"
#include "ods/picture/stored_picture.h"

namespace ods {

// Two fisheyes that share a file.
struct SeenLenses {
  std::vector<FisheyeLens> lenses;  // in pixels of the halves
  bool front_and_back = false;      // the second one looks back (its yaw is 0 all the same, as in FormatHint)
  float alike = 0.0f;               // as OppositeLenses::alike, only for front and back
  FovSource fov_source = FovSource::kNothing;
  float around = 0.0f;  // as Rim::around, of the brighter one
};

// The lenses of two halves. Front and back are aligned. fov: degrees, if it is known. Returns nullopt if the halves
// have no rims.
std::optional<SeenLenses> find_lenses(const LensImages& halves, std::optional<float> fov);

// Returns whether `known` and the name allow lenses. is_open: whether the metadata leave the format open.
bool wants_lenses(const FormatHint& known, const std::string& path, bool is_open);

// Returns `known` with the lenses of a file that was opened as one eye, regardless of its layout, if their circles are
// not inscribed in the eyes' pictures or look ahead and back. Appends the result to `notes`. Precondition:
// wants_lenses().
FormatHint with_lenses(const StoredPicture& whole, const std::string& path, const FormatHint& known,
                       std::vector<std::string>& notes);

}  // namespace ods
