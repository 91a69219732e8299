// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A file too large for memory: random reads, and copies of ranges.
#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "ods/files/atomic_file.h"

namespace ods {

class FileInput {
 public:
  // Throws Error(kInput), as read_file.h does.
  explicit FileInput(const std::string& path);
  FileInput(const FileInput&) = delete;
  FileInput& operator=(const FileInput&) = delete;
  ~FileInput();

  const std::string& path() const { return path_; }
  uint64_t size() const { return size_; }

  // Returns bytes [offset, offset + count). Throws Error(kInput) if the file is, or has become, too short.
  std::string read(uint64_t offset, uint64_t count) const;
  // Reads bytes into memory. Returns false if the file is, or has become, too short or cannot be read.
  bool read(uint64_t offset, void* to, size_t count) const;

  // Appends a range of this file to another: a file system copy where supported, else through a buffer of a few MiB.
  // Bypasses the target's stream. Throws Error(kInput), Error(kOutput).
  void copy(uint64_t offset, uint64_t count, AtomicFile& file) const;

  // Calls `watcher` after every piece that copy() writes, with the total number of bytes copied.
  void watch(std::function<void(uint64_t copied)> watcher) { watcher_ = std::move(watcher); }

  // Gives the new file the permissions of this one.
  void give_mode(AtomicFile& file) const;

 private:
  std::string path_;
  uint64_t size_ = 0;
  int descriptor_ = -1;
  std::function<void(uint64_t)> watcher_;
  mutable uint64_t copied_ = 0;
};

// Appends bytes where FileInput::copy() appends. Throws Error(kOutput).
void append(AtomicFile& file, const std::string& bytes);

}  // namespace ods
