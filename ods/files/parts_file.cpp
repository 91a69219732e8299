// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/parts_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "ods/base/bytes.h"
#include "ods/base/error.h"
#include "ods/files/atomic_file.h"

namespace ods {

static constexpr std::string_view kHead = "omnistereo parts, 2\n";
static constexpr size_t kMaxSettings = size_t{64} << 20;
static constexpr size_t kCheckpoint = 0xffffffff;

static std::string number(uint64_t value, size_t count) {
  std::string bytes;
  append_number(bytes, value, count);
  return bytes;
}

// Fewer at the end of the file.
static std::string read_bytes(std::FILE* stream, size_t count) {
  std::string bytes(count, '\0');
  bytes.resize(std::fread(bytes.data(), 1, count, stream));
  return bytes;
}

static uint64_t place_in(std::FILE* stream) {
  return static_cast<uint64_t>(ftello(stream));
}

PartsFile::PartsFile(const std::string& path, const Settings& settings, bool restart)
    : claim_(claim(path)), path_(path + ".unfinished") {
  const std::string text = settings_text(settings);
  head_ = std::string(kHead) + number(text.size(), 4) + text;
  if (std::filesystem::exists(std::filesystem::symlink_status(path_))) open_old(settings, restart);
}

PartsFile::~PartsFile() {
  if (count_ == 0) remove();
}

void PartsFile::check(bool is_well) const {
  claim_->check();
  if (is_well) return;
  const int why = errno;
  throw Error(ErrorKind::kOutput,
              fmt::format("cannot keep parts in '{}': {}", path_, why == 0 ? "it is damaged" : std::strerror(why)));
}

void PartsFile::open_old(const Settings& settings, bool restart) {
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path_))) {
    throw Error(ErrorKind::kOutput,
                fmt::format("'{}' is not a file of parts: remove it, or choose another name", path_));
  }
  const int file = open(path_.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  check(file >= 0);
  stream_.reset(fdopen(file, "r+b"));
  check(stream_ != nullptr);
  const std::string head = read_bytes(stream_.get(), kHead.size()), length = read_bytes(stream_.get(), 4);
  if (!kHead.starts_with(head)) {
    throw Error(ErrorKind::kOutput,
                fmt::format("'{}' was not written by this version of ods: remove it, or choose another name", path_));
  }
  const size_t size = length.size() == 4 ? get_number(length, 0, 4) : 0;
  const std::string text = size <= kMaxSettings ? read_bytes(stream_.get(), size) : "";
  begin_ = end_ = place_in(stream_.get());
  if (text.size() == size && size > 0) find_end();
  if (restart || count_ == 0) return remove();
  const std::optional<Settings> then = parse_settings(text);
  if (!then) {
    throw Error(ErrorKind::kInput, fmt::format("'{}' is damaged: `restart` discards it and starts over", path_));
  }
  expect_same_settings(path_, *then, settings);
}

void PartsFile::find_end() {
  for (;;) {
    const uint64_t at = place_in(stream_.get());
    const std::string length = read_bytes(stream_.get(), 4);
    if (length.size() < 4) return;
    const uint64_t size = get_number(length, 0, 4);
    if (size != kCheckpoint) {
      check(fseeko(stream_.get(), static_cast<off_t>(size), SEEK_CUR) == 0);
      continue;
    }
    const std::string place = read_bytes(stream_.get(), 8);
    if (place.size() < 8 || get_number(place, 0, 8) != at) return;
    end_ = place_in(stream_.get());
    count_++;
  }
}

void PartsFile::read(const std::function<void(std::string_view record)>& take) {
  if (count_ == 0) return;
  check(fseeko(stream_.get(), static_cast<off_t>(begin_), SEEK_SET) == 0);
  while (place_in(stream_.get()) < end_) {
    const size_t size = get_number(read_bytes(stream_.get(), 4), 0, 4);
    const std::string record = read_bytes(stream_.get(), size == kCheckpoint ? 8 : size);
    if (size != kCheckpoint) take(record);
  }
  check(ftruncate(fileno(stream_.get()), static_cast<off_t>(end_)) == 0 &&
        fseeko(stream_.get(), static_cast<off_t>(end_), SEEK_SET) == 0);
}

void PartsFile::add(std::string_view record) {
  if (stream_ == nullptr) {
    remember_unfinished(path_.c_str());  // before it exists, so that no signal falls between
    stream_.reset(std::fopen(path_.c_str(), "wbxe"));
    check(stream_ != nullptr && std::fwrite(head_.data(), 1, head_.size(), stream_.get()) == head_.size());
  }
  const std::string length = number(record.size(), 4);
  check(std::fwrite(length.data(), 1, 4, stream_.get()) == 4 &&
        std::fwrite(record.data(), 1, record.size(), stream_.get()) == record.size());
}

// A mark is written only when all before it is on the disk.
void PartsFile::end_part() {
  check(std::fflush(stream_.get()) == 0 && fsync(fileno(stream_.get())) == 0);
  const std::string mark = number(kCheckpoint, 4) + number(place_in(stream_.get()), 8);
  check(std::fwrite(mark.data(), 1, mark.size(), stream_.get()) == mark.size() && std::fflush(stream_.get()) == 0);
  forget_unfinished(path_.c_str());
  count_++;
}

void PartsFile::remove() {
  if (stream_ == nullptr) return;
  stream_.reset();
  std::remove(path_.c_str());
  forget_unfinished(path_.c_str());
  count_ = 0;
}

}  // namespace ods
