// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Bytes in memory under a path that any file reader can open.
#pragma once
#include <string>
#include <string_view>

namespace ods {

class MemoryFile {
 public:
  // Throws Error(kMemory).
  explicit MemoryFile(std::string_view bytes);
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile();

  // Valid during the lifetime of the object; readers that have opened it may keep reading.
  std::string path() const;

 private:
  int descriptor_ = -1;
};

}  // namespace ods
