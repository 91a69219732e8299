// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/image_limits.h"

#include <fmt/format.h>

#include <algorithm>

namespace ods {

static std::string excess(int width, int height) {
  return fmt::format("{}x{} pixels exceed the limits of {} per side and {} in all", width, height, kMaxSide,
                     kMaxPixels);
}

std::string image_size_fault(int width, int height) {
  const bool fits = std::max(width, height) <= kMaxSide && int64_t{width} * height <= kMaxPixels;
  return fits ? "" : excess(width, height);
}

std::string image_size_fault(int width, int height, int longest, size_t file_size) {
  if (width < 1 || height < 1) return "it has no pixels";
  const int64_t pixels = int64_t{width} * height;
  const int64_t maximum = std::max(kSmallPixels, kMaxPixelsPerByte * static_cast<int64_t>(file_size));
  if (longest > kMaxSide || pixels > kMaxPixels) return excess(width, height);
  if (pixels > maximum) {
    return fmt::format("{}x{} pixels in {} bytes: the file is broken or hostile", width, height, file_size);
  }
  return {};
}

}  // namespace ods
