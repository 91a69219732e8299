// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Depth as 1 / metres, which is nearly linear over the picture of a plane: 0 is infinitely far.
#pragma once
#include <cstdint>

#include "ods/base/extent.h"
#include "ods/depth/depth_file.h"
#include "ods/depth/depth_format.h"

namespace ods {

struct Nearness {
  Image values;         // 1 channel, 1 / metres, finite, never negative
  int64_t invalid = 0;  // numbers that are no depth: NaN, negative, for distances 0; they count as far away
};

// What the numbers mean. Throws Error(kUsage): a format that needs more to be known; Error(kInput): numbers that cannot
// be a depth picture, all equal or most of them invalid.
Nearness nearness_of(const DepthNumbers& depth, const DepthFormat& format);

// In another size, linearly between pixels. wraps: the last column touches the first. crisp: never between a thing and
// what is behind it; there the nearest pixel counts.
Image resized(const Image& nearness, Extent size, bool wraps, bool crisp);

}  // namespace ods
