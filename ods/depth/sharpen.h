// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Edges of soft depth maps, made as sharp as the picture's. A blurred map has depths between a thing and its
// background, where nothing is: moved eyes would see a rubber sheet. Each pixel on such a ramp becomes part of the
// thing or of the background, whichever around it has its colour; where the colours do not tell, the ramp's middle is
// the edge. Pixels that are on no ramp stay as they are, so exact depth does not change.
//
// After the joint bilateral filter (Petschnigg et al. 2004, "Digital Photography with Flash and No-Flash Image Pairs"),
// but with a choice of two in place of a mean, which would be between them again.
#pragma once
#include <cstdint>
#include <vector>

#include "ods/image/image.h"

namespace ods {

// The picture's colours for the eye: 3 bytes a pixel, encoded about as displays do.
struct GuideImage {
  int width = 0, height = 0;
  std::vector<uint8_t> pixels;
  const uint8_t* at(int x, int y) const {
    return &pixels[3 * (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x))];
  }
};

// Returns the number of pixels that changed. nearness: 1 / metres, of the guide's size. radius: half of the width of
// the widest ramp, pixels. wraps: the last column touches the first.
int64_t sharpen_edges(Image& nearness, const GuideImage& guide, int radius, bool wraps);

}  // namespace ods
