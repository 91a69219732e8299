// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Decides whether two images are the eyes of one picture.
#pragma once
#include <vector>

#include "ods/image/image.h"

namespace ods {

// Two eyes at one place show nearly the same; two parts of one picture do not. Parallax has one sign; matches between
// two similar sides of a scene have both, or, if the scene repeats itself exactly, none. Without parallax, two eyes
// match everywhere.
struct EyeMatch {
  int places = 0;           // places with detail in both images
  double share = 0.0;       // fraction of the places that is found in the other image
  double one_sign = 0.0;    // fraction of the parallax that has one sign, 0..1
  bool is_still = false;    // nothing moves
  bool is_shifted = false;  // one eye lies beside its place or above it as a whole, as on a scanned stereo card
  double mark() const;      // -1 for two parts of one picture, 1 for two eyes, 0 if undecided
};

// Compares the luminance of both images, linear, 1 channel, of equal size. The images are compared as stored, whatever
// their projection.
EyeMatch match_eyes(const std::vector<Image>& eyes);

}  // namespace ods
