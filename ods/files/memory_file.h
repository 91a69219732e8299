// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Bytes in memory under a name that every reader of files opens.
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

  // Good while the object is there; who has opened it may go on reading.
  std::string path() const;

 private:
  int descriptor_ = -1;
};

}  // namespace ods
