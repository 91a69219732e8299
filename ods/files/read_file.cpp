// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/read_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/base/text.h"

namespace ods {

Error cannot_read(const std::string& path, const std::string& why) {
  return Error(ErrorKind::kInput, fmt::format("cannot read '{}': {}", path, valid_utf8(why)));
}

size_t file_size(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) throw cannot_read(path, "no such file");
  if (error) throw cannot_read(path, error.message());
  // Opening a folder reads without end, and a pipe blocks.
  if (!std::filesystem::is_regular_file(status)) throw cannot_read(path, "it is not a file");
  const uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw cannot_read(path, error.message());
  return static_cast<size_t>(size);
}

std::string file_identity(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return "";
  const auto size = std::filesystem::file_size(path, error);
  const auto time = std::filesystem::last_write_time(path, error).time_since_epoch().count();
  return error ? "" : fmt::format("{} bytes, of {}", size, time);
}

std::vector<unsigned char> read_start(const std::string& path, size_t count) {
  count = std::min(count, file_size(path));
  check_memory(count, fmt::format("reading '{}'", path), "use a machine with more");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw cannot_read(path, errno != 0 ? std::strerror(errno) : "it does not open");
  std::vector<unsigned char> bytes(count);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count))) {
    throw cannot_read(path, "reading stopped halfway");
  }
  return bytes;
}

std::vector<unsigned char> read_file(const std::string& path, size_t maximum) {
  const size_t size = file_size(path);
  if (size > maximum) {
    throw cannot_read(path,
                      fmt::format("it has {}; the limit for such a file is {}", bytes_text(size), bytes_text(maximum)));
  }
  return read_start(path, size);
}

std::string read_text(const std::string& path, size_t maximum) {
  const std::vector<unsigned char> bytes = read_file(path, maximum);
  return {bytes.begin(), bytes.end()};
}

}  // namespace ods
