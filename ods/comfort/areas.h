// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Areas of a picture's depth: connected areas, whose pixels touch and are about equally far away, and blocks.
#pragma once
#include <vector>

#include "ods/image/image.h"

namespace ods {

struct AreaGrid {
  int width, height;
  bool wraps;                   // the last column touches the first
  std::vector<bool> is_in;      // for each pixel: it is in an area
  std::vector<float> nearness;  // 1 / metres
};

// Returns the number of each pixel's area, from 0 on; -1: not in an area.
std::vector<int> connected_areas(const AreaGrid& grid);

// Returns depth at most `max_width` wide: the nearest of each block of pixels. Blocks without a depth are NaN. chosen:
// gets the index of each block's nearest pixel.
Image nearest_of_blocks(const Image& depth, int max_width, std::vector<size_t>* chosen = nullptr);

}  // namespace ods
