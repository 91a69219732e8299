// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// JPEGs of two eyes as cameras and viewers write them.
#pragma once
#include <string>

#include "ods/base/bytes.h"
#include "ods/image/format/jpeg_segments.h"

namespace ods::made {

inline constexpr uint32_t kDisparity = 0x020002;

// An MPO of two JPEGs. type: of both pictures in its index.
inline std::string mpo(const std::string& left, const std::string& right, uint32_t type = kDisparity, bool big = true) {
  const auto number = [&](uint64_t value, size_t count) {
    std::string bytes;
    append_number(bytes, value, count);
    return big ? bytes : std::string(bytes.rbegin(), bytes.rend());
  };
  const auto segment = [&](uint64_t first, uint64_t offset) {
    std::string index = (big ? "MM" : "II") + number(42, 2) + number(8, 4) + number(1, 2);
    index += number(0xB002, 2) + number(7, 2) + number(32, 4) + number(8 + 2 + 12 + 4, 4) + number(0, 4);
    index += number(0x20000000 | type, 4) + number(first, 4) + number(0, 4) + number(0, 4);
    index += number(type, 4) + number(right.size(), 4) + number(offset, 4) + number(0, 4);
    return jpeg_segment(0xE2, std::string("MPF\0", 4) + index);
  };
  const uint64_t first = left.size() + segment(0, 0).size();
  const uint64_t start = 2 + 4 + 4;  // of the index in the file
  return left.substr(0, 2) + segment(first, first - start) + left.substr(2) + right;
}

// A JPEG with the descriptor of a JPS. flags: 1 half height, 2 half width, 4 left eye first. layout: 1 rows, 2 side by
// side, 3 above each other, 4 anaglyph. type: 1 for two eyes.
inline std::string jps(const std::string& jpeg, int flags, int layout, int type = 1) {
  const std::string descriptor{
      '\0', '\4', '\0', static_cast<char>(flags), static_cast<char>(layout), static_cast<char>(type)};
  return jpeg.substr(0, 2) + jpeg_segment(0xE3, "_JPSJPS_" + descriptor) + jpeg.substr(2);
}

}  // namespace ods::made
