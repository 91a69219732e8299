// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A checksum fast enough for pixels: several GB/s.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace ods {

// CRC-32 as in zip, PNG and Matroska. start: the CRC of the preceding bytes.
uint32_t crc32(std::span<const std::byte> bytes, uint32_t start = 0);
inline uint32_t crc32(std::string_view bytes, uint32_t start = 0) {
  return crc32(std::as_bytes(std::span(bytes)), start);
}

}  // namespace ods
