// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Positions of pixels in their picture.
#pragma once
#include <algorithm>

#include "ods/base/extent.h"
#include "ods/image/image.h"
#include "ods/kernel/math.h"

namespace ods {

// The centre of a pixel: 0..1 from the left and from the top.
inline vec2 pixel_middle(int x, int y, Extent size) {
  return {(static_cast<float>(x) + 0.5f) / static_cast<float>(size.width),
          (static_cast<float>(y) + 0.5f) / static_cast<float>(size.height)};
}
inline vec2 pixel_middle(int x, int y, const Image& image) {
  return pixel_middle(x, y, Extent{image.width, image.height});
}

// The pixel at a position, 0..1 from the left and from the top. Positions beyond an edge give the pixel at the edge.
inline glm::ivec2 pixel_at(vec2 uv, Extent size) {
  return {std::clamp(static_cast<int>(uv.x * static_cast<float>(size.width)), 0, size.width - 1),
          std::clamp(static_cast<int>(uv.y * static_cast<float>(size.height)), 0, size.height - 1)};
}
inline glm::ivec2 pixel_at(vec2 uv, const Image& image) {
  return pixel_at(uv, Extent{image.width, image.height});
}

}  // namespace ods
