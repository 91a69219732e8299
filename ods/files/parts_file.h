// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The finished parts of a file, saved in FILE.unfinished beside it, so that the same job can resume after it was
// killed.
//
// The file contains records, and marks after which all records so far are on the disk: each mark ends a part. Bytes
// after the last mark, which a killed process wrote, are cut off. One process at a time holds the file (claim.h).
//
// Bytes: the line "omnistereo parts, 2", where 2 is the version of the format; the length of the settings as 4 bytes,
// and the settings; then for each record its length as 4 bytes, and its bytes. A mark has the length 0xffffffff and is
// followed by its own place in the file, 8 bytes. Numbers are big-endian.
#pragma once
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "ods/base/settings.h"
#include "ods/files/claim.h"

namespace ods {

class PartsFile {
 public:
  // Opens the parts of the file at `path`. settings: everything that they depend on. `restart` removes existing parts.
  // Throws Error(kUsage) if there are parts that were made with other settings; Error(kInput) if the parts are damaged;
  // Error(kOutput) if another process makes that file, or FILE.unfinished was not written by ods.
  PartsFile(const std::string& path, const Settings& settings, bool restart = false);
  PartsFile(const PartsFile&) = delete;
  PartsFile& operator=(const PartsFile&) = delete;
  // Removes the file if it has no part.
  ~PartsFile();

  const std::string& path() const { return path_; }
  int count() const { return count_; }  // finished parts

  // Calls `take` with the records of all finished parts, in order. Throws Error(kOutput).
  void read(const std::function<void(std::string_view record)>& take);
  // Throws Error(kOutput).
  void add(std::string_view record);
  void end_part();

  // Removes the parts. Call it when the file itself is complete.
  void remove();

 private:
  void open_old(const Settings& settings, bool restart);
  void find_end();
  void check(bool is_well) const;

  std::unique_ptr<Claim> claim_;
  std::string path_, head_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream_{nullptr, std::fclose};
  uint64_t begin_ = 0, end_ = 0;  // of the finished parts
  int count_ = 0;
};

}  // namespace ods
