// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How large an image file may be to be read.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace ods {

inline constexpr int kMaxSide = 32768;
inline constexpr int64_t kMaxPixels = int64_t{1} << 28;
inline constexpr int64_t kSmallPixels = int64_t{1} << 24;
inline constexpr int64_t kMaxPixelsPerByte = 1024;
inline constexpr size_t kMaxFileBytes = size_t{1} << 32;  // of a file, before it is read

// Why an image is refused before a pixel of it is allocated: longer sides, more pixels, or a file that declares more
// than a small picture in next to no bytes. Empty: it is not. `longest` is the longest side of it and of its tiles.
std::string image_size_fault(int width, int height, int longest, size_t file_size);

}  // namespace ods
