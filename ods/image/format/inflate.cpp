// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/inflate.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>

namespace ods {

std::optional<std::string> inflated(std::string_view bytes, size_t longest) {
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> unpacker(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (!unpacker) return std::nullopt;
  // The length is not stored. Room for more than it needs is tried step by step.
  for (size_t room = std::max<size_t>(4 * bytes.size(), 4096); room / 4 <= longest; room *= 4) {
    std::string result(std::min(room, longest), '\0');
    size_t count = 0;
    const libdeflate_result got =
        libdeflate_zlib_decompress(unpacker.get(), bytes.data(), bytes.size(), result.data(), result.size(), &count);
    if (got == LIBDEFLATE_SUCCESS) return result.substr(0, count);
    if (got != LIBDEFLATE_INSUFFICIENT_SPACE) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace ods
