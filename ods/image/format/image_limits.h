// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Limits on the image files that we read, and so on those that we write.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace ods {

inline constexpr int kMaxSide = 32768;
inline constexpr int64_t kMaxPixels = int64_t{1} << 28;
inline constexpr int64_t kSmallPixels = int64_t{1} << 24;
inline constexpr int64_t kMaxPixelsPerByte = 1024;
inline constexpr size_t kMaxFileBytes = size_t{1} << 32;  // per file, checked before reading

// The reason why an image is rejected before its pixels are allocated: a side too long, too many pixels, or more pixels
// than a file of this size can plausibly contain. Empty if it is accepted. `longest` is the longest side of the image
// and its tiles.
std::string image_size_fault(int width, int height, int longest, size_t file_size);

// Why an image of this size is not written: it would be refused. Empty: it can be.
std::string image_size_fault(int width, int height);

}  // namespace ods
