// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Connected areas of a picture: pixels that touch and are about as far away.
#pragma once
#include <vector>

namespace ods {

struct AreaGrid {
  int width, height;
  bool wraps;                   // the last column touches the first
  std::vector<bool> is_in;      // by pixel: whether it belongs to an area at all
  std::vector<float> nearness;  // 1 / metres
};

// The number of each pixel's area, from 0 on; -1: in none.
std::vector<int> connected_areas(const AreaGrid& grid);

}  // namespace ods
