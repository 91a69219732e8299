// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A file that is too large for memory: read here and there, copied in ranges.
#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "ods/files/atomic_file.h"

namespace ods {

class FileInput {
 public:
  // Throws Error(kInput), as read_file.h.
  explicit FileInput(const std::string& path);
  FileInput(const FileInput&) = delete;
  FileInput& operator=(const FileInput&) = delete;
  ~FileInput();

  const std::string& path() const { return path_; }
  uint64_t size() const { return size_; }

  // Bytes offset .. offset + count. Throws Error(kInput) where the file has not so many (any more).
  std::string read(uint64_t offset, uint64_t count) const;

  // Appends a range of it to a file; in the file system where that can copy, else through a buffer of a few MiB. Never
  // through the file's stream. Throws Error(kInput), Error(kOutput).
  void copy(uint64_t offset, uint64_t count, AtomicFile& file) const;

  // Calls this after every piece that copy() has copied, with the bytes that it has copied in all.
  void watch(std::function<void(uint64_t copied)> watcher) { watcher_ = std::move(watcher); }

  // The file is to be as readable as this one.
  void give_mode(AtomicFile& file) const;

 private:
  std::string path_;
  uint64_t size_ = 0;
  int descriptor_ = -1;
  std::function<void(uint64_t)> watcher_;
  mutable uint64_t copied_ = 0;
};

// Appends bytes where FileInput::copy() does. Throws Error(kOutput).
void append(AtomicFile& file, const std::string& bytes);

}  // namespace ods
