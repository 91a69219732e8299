// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The ways to cut a file of unknown layout into eyes, and the evidence for each of them.
#pragma once
#include <string>
#include <vector>

#include "ods/camera/layout.h"
#include "ods/identify/marks.h"
#include "ods/identify/pairs.h"
#include "ods/identify/thumbnail.h"

namespace ods {

// One way to cut the file, and the evidence in the resulting eyes. Squeezed layouts cut it as full ones do.
struct Cut {
  EyePacking how = EyePacking::kAlone;
  double two_eyes = 0.0;  // as EyeMatch::mark(); for one eye, that no other cut shows two
  std::string reason;
  std::vector<Image> eyes;   // linear
  Image shown;               // the first eye, as a display shows it
  Marks marks;               // marks of the first eye
  bool has_bars = false;     // black bars around the file
  bool is_still = false;     // as EyeMatch::is_still
  bool is_copy = false;      // both eyes are the same picture
  double broken = 0.0;       // as breaks_in_middle()
  double other_faces = 0.0;  // evidence that it has the faces of a cube in an order that we do not support
  PointPairs pairs;          // pairs between both eyes
};

// The cuts that the file's size allows; the first one is one eye. `whole` as in make_thumbnail().
std::vector<Cut> all_cuts(const StoredPicture& whole, const Thumbnail& thumbnail);

}  // namespace ods
