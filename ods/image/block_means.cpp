// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/block_means.h"

namespace ods {

Image block_means(const Image& image, int by) {
  Image small(image.width / by, image.height / by, 1);
  for (int y = 0; y < small.height; y++) {
    for (int x = 0; x < small.width; x++) {
      float sum = 0.0f;
      for (int i = 0; i < by * by; i++) sum += *image.at(x * by + i % by, y * by + i / by);
      *small.at(x, y) = sum / static_cast<float>(by * by);
    }
  }
  return small;
}

}  // namespace ods
