// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The file with the pipelines that a driver has compiled, in a folder of the user. A driver knows its own data by the
// UUID in the file's name; a checksum protects it from a file that is cut short, since drivers trust what they read.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace ods {

class PipelineCacheFile {
 public:
  PipelineCacheFile() = default;
  // folder: none if empty; then nothing is read or written. uuid: 16 bytes, of the driver.
  PipelineCacheFile(std::string folder, std::span<const uint8_t, 16> uuid);

  // Returns the data; empty if there is no file, or it is damaged.
  std::vector<std::byte> read() const;

  // Stores the data for this user alone. A failure is ignored: the next program compiles again.
  void write(std::span<const std::byte> data) const;

  const std::string& path() const { return path_; }  // empty without a folder

 private:
  std::string folder_;
  std::string path_;
};

}  // namespace ods
