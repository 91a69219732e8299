// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What is compared: an eye as a small grey lat-long picture, whatever its projection was.
#pragma once
#include <vector>

#include "ods/camera/projection.h"
#include "ods/image/image.h"

namespace ods {

// One channel, twice as wide as high, the whole sphere: about what a display shows, 0..1; NaN where the picture does
// not reach or has no number.
using GrayView = Image;

// Two eyes are shown with one exposure. Never more than max_width wide, nor wider than the eyes have detail for.
// Precondition: one or two eyes of one size, 1 channel.
std::vector<GrayView> make_gray_views(const std::vector<Image>& eyes, const ProjectionSetting& projection,
                                      bool is_float, int max_width);

}  // namespace ods
