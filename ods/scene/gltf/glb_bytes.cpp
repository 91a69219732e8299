// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/gltf/glb_bytes.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>

#include "ods/base/error.h"

namespace ods {

static void append_uint(std::string& bytes, size_t value) {
  const uint32_t number = static_cast<uint32_t>(value);  // glTF and all processors that ods runs on are little-endian
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

static void append_chunk(std::string& bytes, const char* type, const std::string& chunk, char filler) {
  const size_t size = (chunk.size() + 3) / 4 * 4;
  append_uint(bytes, size);
  bytes.append(type, 4);
  bytes += chunk;
  bytes.append(size - chunk.size(), filler);
}

std::string glb_bytes(const std::string& json, const std::string& binary, const std::string& path,
                      const std::string& remedy) {
  constexpr size_t kHeaders = 12 + 2 * 8 + 6;  // with the chunks' fillers
  if (kHeaders + json.size() + binary.size() > std::numeric_limits<uint32_t>::max()) {
    throw Error(ErrorKind::kOutput, fmt::format("cannot write '{}': a .glb holds at most 4 GB; {}", path, remedy));
  }
  std::string bytes = "glTF";
  append_uint(bytes, 2);
  append_uint(bytes, 0);
  append_chunk(bytes, "JSON", json, ' ');
  if (!binary.empty()) append_chunk(bytes, "BIN\0", binary, '\0');
  std::string size;
  append_uint(size, bytes.size());
  return bytes.replace(8, 4, size);
}

}  // namespace ods
