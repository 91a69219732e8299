// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/zip_archive.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <filesystem>
#include <new>

#include "ods/base/memory.h"
#include "ods/base/text.h"
#include "ods/files/read_file.h"

namespace ods {

bool is_zip(std::span<const unsigned char> start) {
  return start.size() >= 4 && start[0] == 'P' && start[1] == 'K' &&
         ((start[2] == 3 && start[3] == 4) || (start[2] == 5 && start[3] == 6));  // the second one is empty
}

struct ZipArchive::Handle {
  zip_t* archive = nullptr;
  ~Handle() {
    if (archive) zip_discard(archive);
  }
};

// Why libzip failed, for a message.
static std::string words(zip_error_t* error) {
  const int code = zip_error_code_zip(error);
  if (code == ZIP_ER_MEMORY) throw std::bad_alloc();
  if (code == ZIP_ER_NOPASSWD) return "it is encrypted";
  return fmt::format("it is damaged, or not supported ({})", one_line(zip_error_strerror(error)));
}

// The name by which other files refer to it; empty for a folder, and for a name that leads out of the archive.
static std::string plain_name(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');  // some Windows programs
  if (name.empty() || name.starts_with('/') || name.ends_with('/')) return "";
  const std::string normal = std::filesystem::path(name).lexically_normal().generic_string();
  return normal == ".." || normal.starts_with("../") ? "" : normal;
}

ZipArchive::ZipArchive(std::span<const unsigned char> bytes, const std::string& path)
    : path_(path), handle_(std::make_unique<Handle>()) {
  constexpr size_t kSmall = size_t{1} << 28, kMaxPerByte = 100;
  budget_ = kSmall + kMaxPerByte * bytes.size();
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source) handle_->archive = zip_open_from_source(source, ZIP_RDONLY, &error);
  if (!handle_->archive) {
    zip_source_free(source);
    const std::string why = words(&error);
    zip_error_fini(&error);
    throw cannot_read(path, fmt::format("it looks like a .zip archive, but {}", why));
  }
  const auto count = static_cast<uint64_t>(std::max<zip_int64_t>(0, zip_get_num_entries(handle_->archive, 0)));
  for (uint64_t i = 0; i < count; i++) {
    zip_stat_t entry;
    if (zip_stat_index(handle_->archive, i, 0, &entry) != 0) continue;
    if ((entry.valid & ZIP_STAT_NAME) == 0 || (entry.valid & ZIP_STAT_SIZE) == 0) continue;
    const std::string name = plain_name(entry.name);
    if (!name.empty()) entries_.emplace(name, Entry{i, static_cast<size_t>(entry.size)});
  }
  for (const auto& [name, entry] : entries_) names_.emplace(small_letters(name), name);
}

ZipArchive::~ZipArchive() = default;

std::vector<std::string> ZipArchive::names() const {
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries_) names.push_back(name);
  return names;
}

std::string ZipArchive::find_ignoring_case(const std::string& name) const {
  const auto found = names_.find(small_letters(name));
  return found == names_.end() ? "" : found->second;
}

size_t ZipArchive::size_of(const std::string& name) const {
  const auto found = entries_.find(name);
  return found == entries_.end() ? 0 : found->second.size;
}

std::vector<unsigned char> ZipArchive::read(const std::string& name) {
  const auto found = entries_.find(name);
  if (found == entries_.end()) throw cannot_read(path_, fmt::format("it holds no file '{}'", one_line(name)));
  const Entry entry = found->second;
  const std::lock_guard lock(mutex_);  // libzip's handles are for one thread at a time
  if (entry.size > budget_) {
    throw cannot_read(path_, fmt::format("its file '{}' unpacks to far more than an archive of its size can hold ({})",
                                         one_line(name), bytes_text(entry.size)));
  }
  budget_ -= entry.size;
  check_memory(entry.size, fmt::format("unpacking '{}' of '{}'", one_line(name), path_), "use a machine with more");
  std::vector<unsigned char> bytes(entry.size);
  const auto fail = [&](const std::string& why) {
    return cannot_read(path_, fmt::format("its file '{}' cannot be unpacked: {}; unpack the archive with another "
                                          "program and name the file in it",
                                          one_line(name), why));
  };
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen_index(handle_->archive, entry.index, 0),
                                                               zip_fclose);
  if (!file) throw fail(words(zip_get_error(handle_->archive)));
  size_t done = 0;
  unsigned char beyond;  // reading it reports a wrong checksum
  while (true) {
    const bool whole = done == bytes.size();
    const zip_int64_t got = zip_fread(file.get(), whole ? &beyond : &bytes[done], whole ? 1 : bytes.size() - done);
    if (got < 0) throw fail(words(zip_file_get_error(file.get())));
    if (got == 0 && whole) return bytes;
    if (got == 0 || whole) throw fail("it is damaged: its size is not the one that the archive states");
    done += static_cast<size_t>(got);
  }
}

}  // namespace ods
