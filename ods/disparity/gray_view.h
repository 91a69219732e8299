// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The views for comparison: each eye as a small grey lat-long picture, converted from its projection.
#pragma once
#include <vector>

#include "ods/camera/projection.h"
#include "ods/image/image.h"

namespace ods {

// One channel, twice as wide as high, covering the whole sphere: approximately display values, 0..1; NaN where the
// picture ends or is not finite.
using GrayView = Image;

// Makes the views, with the same exposure for both eyes. A view is at most max_width wide, and no wider than the eyes'
// resolution supports. Precondition: one or two eyes of the same size, 1 channel.
std::vector<GrayView> make_gray_views(const std::vector<Image>& eyes, const ProjectionSetting& projection,
                                      bool is_float, int max_width);

// The fraction of the horizon that a view covers.
double seen_around(const GrayView& view);

}  // namespace ods
