// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The detail inside an image circle. It is the same in two lenses of unlike exposure, and in the dark near a rim, and
// smooth areas have none.
#pragma once
#include "ods/camera/direction_map.h"
#include "ods/image/image.h"

namespace ods {

// Sizes relative to the radius of the circle.
struct DetailScale {
  float smooth = 0.0f;  // side of the square that is averaged against noise
  float wide = 0.0f;    // side of the square whose mean and spread are removed
};
inline constexpr DetailScale kCoarseDetail{0.035f, 0.2f}, kFineDetail{0.012f, 0.1f};

// The deviation from the local mean in units of the local spread, about -2..2; 0 outside the circle. image: 1 channel,
// as a display shows it, 0..1.
Image lens_detail(const Image& image, const FisheyeLens& lens, const DetailScale& scale);

}  // namespace ods
