// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Depth as 1 / metres, which is nearly linear over the picture of a plane; 0 is infinitely far.
#pragma once
#include <cstdint>

#include "ods/base/extent.h"
#include "ods/depth/depth_file.h"
#include "ods/depth/depth_format.h"

namespace ods {

struct Nearness {
  Image values;         // 1 channel, 1 / metres, finite, never negative
  int64_t invalid = 0;  // numbers that are not a depth: NaN, negative, for distances 0; treated as far away
};

// Converts a file's numbers. Throws Error(kUsage) for a format that needs more information; Error(kInput) for numbers
// that cannot be a depth picture, because all are equal or most are invalid.
Nearness nearness_of(const DepthNumbers& depth, const DepthFormat& format);

// Resizes linearly between pixels. wraps: the last column is next to the first. crisp: does not interpolate between an
// object and its background, but uses the nearest pixel there.
Image resized(const Image& nearness, Extent size, bool wraps, bool crisp);

}  // namespace ods
