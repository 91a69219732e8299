// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the other eye sees the surface that a pixel shows.
#pragma once
#include <optional>

#include "ods/denoise/noisy_picture.h"

namespace ods {

struct OtherPlace {
  int eye = 0;    // index in Picture::eyes
  vec2 at{0.0f};  // pixels from the left and top edge: the centre of the first texel is 0.5
  Cell cell;      // around it
};

// Nothing if the other eye does not see the surface, or nobody knows how far it is. Precondition: two eyes.
std::optional<OtherPlace> place_in_other_eye(const NoisyPicture& noisy, int eye, int x, int y);

}  // namespace ods
