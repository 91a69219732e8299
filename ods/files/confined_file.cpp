// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/confined_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "ods/files/read_file.h"

namespace fs = std::filesystem;

namespace ods {

ConfinedFile::ConfinedFile(const std::string& path, const std::string& folder, Reach reach)
    : path_(path), opened_(path) {
  if (folder.empty()) return;
  const Error outside = cannot_read(path, fmt::format("it is outside '{}'", folder));
  std::error_code error;
  const auto is_allowed = [&](const fs::path& real) {
    if (reach == Reach::kDirectly) return real == fs::path(folder) / fs::path(path).filename();
    return real.native().starts_with(folder.ends_with('/') ? folder : folder + "/");
  };
  if (!is_allowed(fs::weakly_canonical(fs::absolute(path), error))) throw outside;
  file_size(path);  // throws the error with this name
  descriptor_ = open(path.c_str(), O_PATH | O_CLOEXEC);
  if (descriptor_ < 0) throw cannot_read(path, std::strerror(errno));
  opened_ = fmt::format("/proc/self/fd/{}", descriptor_);
  if (is_allowed(fs::read_symlink(opened_, error))) return;
  close(descriptor_);
  throw outside;
}

std::string ConfinedFile::with_given_path(std::string text) const {
  if (descriptor_ < 0) return text;
  for (size_t at = text.find(opened_); at != std::string::npos; at = text.find(opened_, at + path_.size())) {
    text.replace(at, opened_.size(), path_);
  }
  return text;
}

ConfinedFile::~ConfinedFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace ods
