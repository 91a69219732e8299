// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/read_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "ods/base/error.h"

namespace ods {

std::vector<unsigned char> read_file(const std::string& path) {
  const auto cannot_read = [&](const std::string& why) {
    return Error(ErrorKind::kInput, fmt::format("cannot read '{}': {}", path, why));
  };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw cannot_read("no such file");
  // A folder opens as if it were endless, a pipe waits for ever.
  if (!std::filesystem::is_regular_file(status)) throw cannot_read("it is not a file");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  const uintmax_t size = std::filesystem::file_size(path, error);
  if (!stream || error) throw cannot_read(errno != 0 ? std::strerror(errno) : "it does not open");
  std::vector<unsigned char> bytes(size);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    throw cannot_read("reading stopped halfway");
  }
  return bytes;
}

}  // namespace ods
