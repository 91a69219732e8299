// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/comfort/areas.h"

#include <algorithm>
#include <limits>

#include "ods/picture/picture.h"

namespace ods {

std::vector<int> connected_areas(const AreaGrid& grid) {
  std::vector<int> areas(grid.is_in.size(), -1);
  std::vector<size_t> open;
  int count = 0;
  const auto width = static_cast<size_t>(grid.width);
  const auto enter = [&](size_t from, size_t to) {
    if (areas[to] >= 0 || !grid.is_in[to] || !is_one_surface(grid.nearness[from], grid.nearness[to])) return;
    areas[to] = areas[from];
    open.push_back(to);
  };
  for (size_t start = 0; start < areas.size(); start++) {
    if (areas[start] >= 0 || !grid.is_in[start]) continue;
    areas[start] = count++;
    open.push_back(start);
    while (!open.empty()) {
      const size_t at = open.back(), x = at % width, row = at - x;
      open.pop_back();
      if (x > 0 || grid.wraps) enter(at, row + (x + width - 1) % width);
      if (x + 1 < width || grid.wraps) enter(at, row + (x + 1) % width);
      if (at >= width) enter(at, at - width);
      if (at + width < areas.size()) enter(at, at + width);
    }
  }
  return areas;
}

Image nearest_of_blocks(const Image& depth, int max_width, std::vector<size_t>* chosen) {
  const int block = std::max(1, (depth.width + max_width - 1) / max_width);
  Image nearest((depth.width + block - 1) / block, (depth.height + block - 1) / block, 1);
  std::ranges::fill(nearest.pixels, std::numeric_limits<float>::quiet_NaN());
  if (chosen) chosen->assign(nearest.pixels.size(), 0);
  for (int y = 0; y < depth.height; y++) {
    const float* row = depth.at(0, y);
    for (int x = 0; x < depth.width; x++) {
      const size_t at = static_cast<size_t>(nearest.at(x / block, y / block) - nearest.pixels.data());
      float& minimum = nearest.pixels[at];
      if (!(row[x] > 0.0f) || row[x] >= minimum) continue;
      minimum = row[x];
      if (chosen) (*chosen)[at] = static_cast<size_t>(&row[x] - depth.pixels.data());
    }
  }
  return nearest;
}

}  // namespace ods
