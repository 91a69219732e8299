// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Where pixels are in their picture.
#pragma once
#include "ods/base/extent.h"
#include "ods/image/image.h"
#include "ods/kernel/math.h"

namespace ods {

// The middle of a pixel: 0..1 from the left and from the top.
inline vec2 pixel_middle(int x, int y, Extent size) {
  return {(static_cast<float>(x) + 0.5f) / static_cast<float>(size.width),
          (static_cast<float>(y) + 0.5f) / static_cast<float>(size.height)};
}
inline vec2 pixel_middle(int x, int y, const Image& image) {
  return pixel_middle(x, y, Extent{image.width, image.height});
}

}  // namespace ods
