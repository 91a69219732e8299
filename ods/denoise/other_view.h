// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the surface of a pixel in another view: the other eye's picture, or another frame of a video.
#pragma once
#include <optional>

#include "ods/denoise/noisy_picture.h"

namespace ods {

// One eye's picture at the level that is to be filtered.
struct NoisyView {
  const NoisyPicture& noisy;
  const std::vector<Level>& levels;  // by eye
  int eye = 0;                       // index in Picture::eyes
};

struct ViewPlace {
  vec2 at{0.0f};  // pixels from the left and top edge: the centre of the first texel is 0.5
  Cell cell;      // the cell that contains `at`
};

// The surface in the centre of a pixel, in world coordinates. Returns nullopt if its distance is unknown.
std::optional<vec3> surface_at(const NoisyPicture& noisy, int eye, int x, int y);

// The position of a surface in a view. Returns nullopt if the view does not see it. Precondition: the view's picture
// has depth.
std::optional<ViewPlace> place_in_view(const NoisyView& view, vec3 surface);

}  // namespace ods
