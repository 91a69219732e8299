// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A checksum that is quick enough for pixels: several GB a second.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace ods {

// CRC-32 (that of zip, png and Matroska). `start`: of the bytes before these.
uint32_t crc32(std::span<const std::byte> bytes, uint32_t start = 0);
inline uint32_t crc32(std::string_view bytes, uint32_t start = 0) {
  return crc32(std::as_bytes(std::span(bytes)), start);
}

}  // namespace ods
