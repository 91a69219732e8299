// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/odd_halves.h"

#include <algorithm>

namespace ods {

Extent without_middle(Layout layout, Extent packed) {
  const EyePacking how = arrangement_of(layout).how;
  if (how == EyePacking::kBeside && packed.width > 1) packed.width -= packed.width % 2;
  if (how == EyePacking::kStacked && packed.height > 1) packed.height -= packed.height % 2;
  return packed;
}

Image without_middle(Layout layout, const Image& packed) {
  const Extent size = without_middle(layout, Extent{packed.width, packed.height});
  if (size.width == packed.width && size.height == packed.height) return packed;
  Image even(size.width, size.height, packed.channels);
  for (int y = 0; y < size.height; y++) {
    const int from_y = y + (2 * y >= size.height ? packed.height - size.height : 0);
    for (int x = 0; x < size.width; x++) {
      const int from_x = x + (2 * x >= size.width ? packed.width - size.width : 0);
      std::copy_n(packed.at(from_x, from_y), packed.channels, even.at(x, y));
    }
  }
  return even;
}

}  // namespace ods
