// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a picture file says of itself, without its pixels, and how large it may be.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "ods/image/sample.h"

namespace ods {

// What is refused when read, before a pixel of it is allocated: longer sides, more pixels, and files that declare more
// than a small picture in next to no bytes.
inline constexpr int kMaxSide = 32768;
inline constexpr int64_t kMaxPixels = int64_t{1} << 28;
inline constexpr int64_t kSmallPixels = int64_t{1} << 24;
inline constexpr int64_t kMaxPixelsPerByte = 1024;
inline constexpr size_t kMaxFileBytes = size_t{1} << 32;  // of a file, before it is read

// What a file says of itself, without its pixels.
struct FileInfo {
  int width = 0;
  int height = 0;
  bool is_float = false;                              // light as it is; else code values of a display
  std::vector<std::string> channels;                  // R, G, B, A first
  std::vector<Sample> samples;                        // of every channel, as RowReader gives them
  std::map<std::string, std::string> text;            // attributes that are words, by OpenImageIO's names
  std::map<std::string, std::vector<float>> numbers;  // and those that are numbers
};

}  // namespace ods
