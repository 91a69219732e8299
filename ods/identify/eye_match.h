// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether two images are the eyes of one picture.
#pragma once
#include <vector>

#include "ods/image/image.h"

namespace ods {

// Two eyes at one place show nearly the same; two parts of one picture do not. Parallax has one sign; where a scene is
// alike on two sides, what matches has both.
struct EyeMatch {
  int places = 0;         // with detail in both images
  double share = 0.0;     // of the places: found in the other image
  double one_sign = 0.0;  // of the parallax, 0..1; 1 if nothing moves
  double mark() const;    // -1: two parts of one picture; 1: two eyes; 0: the images do not tell
};

// Luminance of both images, linear, 1 channel, of equal size. Whatever their projection is, they are compared as they
// are stored.
EyeMatch match_eyes(const std::vector<Image>& eyes);

}  // namespace ods
