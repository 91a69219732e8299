// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads parts and little-endian numbers of a file. All functions throw MalformedFile beyond the end.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "ods/base/bytes.h"

namespace ods {

inline std::span<const std::byte> part_of(std::span<const std::byte> bytes, uint64_t at, uint64_t size) {
  if (at > bytes.size() || size > bytes.size() - at) throw MalformedFile("a table in it runs past the end");
  return bytes.subspan(at, size);
}

inline uint64_t get_little(std::span<const std::byte> bytes, size_t at, size_t size) {
  uint64_t value = 0;
  for (const std::byte byte : part_of(bytes, at, size)) value = value >> 8 | static_cast<uint64_t>(byte) << 56;
  return value >> (64 - 8 * size);
}

inline uint32_t get_u16(std::span<const std::byte> bytes, size_t at) {
  return static_cast<uint32_t>(get_little(bytes, at, 2));
}
inline uint32_t get_u32(std::span<const std::byte> bytes, size_t at) {
  return static_cast<uint32_t>(get_little(bytes, at, 4));
}
inline uint64_t get_u64(std::span<const std::byte> bytes, size_t at) {
  return get_little(bytes, at, 8);
}

}  // namespace ods
