// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes the edges of soft depth maps as sharp as the picture's. A blurred map has depths between an object and its
// background, where no surface is: moved eyes would see a rubber sheet. Each pixel on such a ramp becomes part of the
// object or of the background, whichever has its colour in the neighbourhood; if the colours do not decide, the ramp's
// middle is the edge. Pixels that are not on a ramp are unchanged, so exact depth does not change.
//
// After the joint bilateral filter (Petschnigg et al. 2004, "Digital Photography with Flash and No-Flash Image Pairs"),
// but with a choice of two values instead of a mean, which would be between them again.
#pragma once
#include <cstdint>
#include <vector>

#include "ods/image/image.h"

namespace ods {

// The picture's colours for one eye: 3 bytes per pixel, approximately display-encoded.
struct GuideImage {
  int width = 0, height = 0;
  std::vector<uint8_t> pixels;
  const uint8_t* at(int x, int y) const {
    return &pixels[3 * (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x))];
  }
};

// Sharpens the edges and returns the number of changed pixels. nearness: 1 / metres, of the guide's size. radius: half
// of the width of the widest ramp, pixels. wraps: the last column is next to the first.
int64_t sharpen_edges(Image& nearness, const GuideImage& guide, int radius, bool wraps);

}  // namespace ods
