// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/checksum.h"

#include <libdeflate.h>

namespace ods {

uint32_t crc32(std::span<const std::byte> bytes, uint32_t start) {
  if (bytes.empty()) return start;  // libdeflate restarts the checksum for a null pointer
  return libdeflate_crc32(start, bytes.data(), bytes.size());
}

}  // namespace ods
