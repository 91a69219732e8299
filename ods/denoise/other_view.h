// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Where another view shows the surface that a pixel shows: the other eye's picture, or a frame of a video beside it.
#pragma once
#include <optional>

#include "ods/denoise/noisy_picture.h"

namespace ods {

// One eye's picture, in the pass that is to be filtered.
struct NoisyView {
  const NoisyPicture& noisy;
  const std::vector<Level>& levels;  // by eye
  int eye = 0;                       // index in Picture::eyes
};

struct ViewPlace {
  vec2 at{0.0f};  // pixels from the left and top edge: the centre of the first texel is 0.5
  Cell cell;      // around it
};

// The surface in the middle of a pixel, in world coordinates. Nothing if nobody knows how far it is.
std::optional<vec3> surface_at(const NoisyPicture& noisy, int eye, int x, int y);

// Nothing if the view does not see the surface there. Precondition: the view's picture has depth.
std::optional<ViewPlace> place_in_view(const NoisyView& view, vec3 surface);

}  // namespace ods
