// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the rim of a fisheye's image circle: the border between the picture and the sensor around it, which is darker
// but need not be black.
#pragma once
#include <optional>

#include "ods/camera/projection.h"
#include "ods/image/image.h"

namespace ods {

struct Rim {
  vec2 center{0.0f};  // pixels from the left and top edge
  float radius = 0.0f;
  float share = 0.0f;   // fraction of the circle that is in the picture and was recognized as a rim, 0..1
  float around = 0.0f;  // brightness of the sensor around the circle, 0..1
};

// The circle across which the brightness drops most, to about a tenth of a pixel where the scene at the rim is bright
// and the surround black; to about a hundredth of the radius in a glow. Circles may be cut by the image's edges, and
// need not be centred. Returns nullopt if there is no darker, even surround with a round border. `image`: 1 channel, as
// a display shows it, 0..1.
std::optional<Rim> find_rim(const Image& image);

}  // namespace ods
