// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the files in a .zip archive, in memory: nothing is unpacked to disk.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace ods {

// Returns whether these bytes, at least the first four of a file, start a .zip archive.
bool is_zip(std::span<const unsigned char> start);

class ZipArchive {
 public:
  // bytes: the whole archive; the caller keeps them as long as this object lives. path: its name in messages. Throws
  // Error(kInput) if the archive is damaged.
  ZipArchive(std::span<const unsigned char> bytes, const std::string& path);
  ~ZipArchive();

  // The names of its files, sorted, with '/' between folders. Leaves out names that are absolute or lead out of the
  // archive ("..").
  std::vector<std::string> names() const;
  bool holds(const std::string& name) const { return entries_.contains(name); }

  // The first file with this name in any letter case; empty if there is none.
  std::string find_ignoring_case(const std::string& name) const;

  // The size of a file after decompression, as the archive records it; 0 if there is no such file.
  size_t size_of(const std::string& name) const;

  // The whole file; any thread may call this. Throws Error(kInput) if there is no such file, if it is damaged or
  // encrypted, or if the files read so far exceed 256 MB plus 100 times the size of the archive (a decompression bomb);
  // Error(kMemory) if it does not fit in memory.
  std::vector<unsigned char> read(const std::string& name);

 private:
  struct Handle;
  struct Entry {
    uint64_t index = 0;
    size_t size = 0;
  };

  std::string path_;
  std::unique_ptr<Handle> handle_;
  std::map<std::string, Entry> entries_;
  std::map<std::string, std::string> names_;  // by their lower-case names
  size_t budget_;                             // bytes that may still be read
  std::mutex mutex_;
};

}  // namespace ods
