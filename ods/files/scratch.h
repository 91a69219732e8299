// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A large block of bytes that does not count as memory for long: small ones are memory, large ones an unlinked file,
// of which only what was touched lately is in memory.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace ods {

class Scratch {
 public:
  // Zeros. More than `most_in_memory` bytes lie in `folder`, which no other process sees and nothing is left of; with
  // no folder all is memory. Throws Error(kOutput) where the disk has not the room, Error(kMemory) where the memory has
  // not.
  Scratch(size_t size, const std::string& folder, size_t most_in_memory);
  // The same in a file that stays when the process ends: its bytes as another process left them where they are as many,
  // else zeros behind `mark`, with which the file begins. Which of the bytes had reached the disk when the machine lost
  // its power is for the caller to find out. Throws Error(kOutput) as above, where another process has it open, and
  // where something else has that name, which is left as it is: a link, another user's file, one that does not begin
  // with the mark. Precondition: size >= mark.size().
  Scratch(size_t size, const std::string& file, std::string_view mark);
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch();

  std::byte* data() const { return data_; }
  size_t size() const { return size_; }
  bool on_disk() const { return on_disk_; }

  // What lies on the disk leaves the process's memory and comes back when it is touched. Any thread, at any time.
  void release() const;

 private:
  std::byte* data_ = nullptr;
  size_t size_ = 0;
  bool on_disk_ = false;
  int file_ = -1;  // locked
};

}  // namespace ods
