// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A large block of bytes that does not fill memory: small blocks are memory, large ones an unlinked file of which only
// the recently used pages stay in memory.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace ods {

class Scratch {
 public:
  // Zero-initialized. A block above `max_in_memory` bytes goes into an unlinked file in `folder`; without a folder it
  // stays in memory. Throws Error(kOutput) if the disk is too small, Error(kMemory) if memory is.
  Scratch(size_t size, const std::string& folder, size_t max_in_memory);
  // A block in a file that outlives the process. Keeps the bytes that an earlier process left if the size matches;
  // otherwise zeros after `mark`, with which the file begins. After a power loss the caller must find out which bytes
  // had reached the disk. Throws Error(kOutput) as the constructor above, if another process has the file open, and if
  // something else has the name, which is left untouched: a link, another user's file, a file that does not begin with
  // the mark. Precondition: size >= mark.size().
  Scratch(size_t size, const std::string& file, std::string_view mark);
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch();

  std::byte* data() const { return data_; }
  size_t size() const { return size_; }
  bool on_disk() const { return on_disk_; }

  // Evicts the pages that are backed by the disk; they are read back on access. Thread-safe.
  void release() const;

 private:
  std::byte* data_ = nullptr;
  size_t size_ = 0;
  bool on_disk_ = false;
  int file_ = -1;  // locked
};

}  // namespace ods
