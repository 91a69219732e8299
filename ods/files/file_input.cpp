// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/file_input.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "ods/base/error.h"
#include "ods/files/read_file.h"

namespace ods {

FileInput::FileInput(const std::string& path) : path_(path), size_(file_size(path)) {
  descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) throw cannot_read(path, std::strerror(errno));
}

FileInput::~FileInput() {
  close(descriptor_);
}

std::string FileInput::read(uint64_t offset, uint64_t count) const {
  if (offset > size_ || count > size_ - offset) throw cannot_read(path_, "it ends too early");
  std::string bytes(count, '\0');
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t got = pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw cannot_read(path_, std::strerror(errno));
    if (got == 0) throw cannot_read(path_, "it was truncated while being read");
    done += static_cast<size_t>(got);
  }
  return bytes;
}

bool FileInput::read(uint64_t offset, void* to, size_t count) const {
  for (size_t done = 0; done < count;) {
    const ssize_t got =
        pread(descriptor_, static_cast<char*>(to) + done, count - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    done += static_cast<size_t>(got);
  }
  return true;
}

static void write_all(AtomicFile& file, const char* bytes, size_t count) {
  while (count > 0) {
    const ssize_t done = write(fileno(file.stream()), bytes, count);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) {
      throw Error(ErrorKind::kOutput, fmt::format("cannot write '{}': {}", file.path(), std::strerror(errno)));
    }
    bytes += done;
    count -= static_cast<size_t>(done);
  }
}

void append(AtomicFile& file, const std::string& bytes) {
  write_all(file, bytes.data(), bytes.size());
}

void FileInput::copy(uint64_t offset, uint64_t count, AtomicFile& file) const {
  constexpr uint64_t kAtOnce = uint64_t{64} << 20;
  const auto advance = [&](uint64_t bytes) {
    count -= bytes;
    copied_ += bytes;
    if (watcher_) watcher_(copied_);
  };
  off_t from = static_cast<off_t>(offset);
  while (count > 0) {
    const ssize_t done =
        copy_file_range(descriptor_, &from, fileno(file.stream()), nullptr, std::min(count, kAtOnce), 0);
    if (done <= 0) break;  // other file systems, old kernels, a full disk: the copy below reports it
    advance(static_cast<uint64_t>(done));
  }
  constexpr uint64_t kBuffer = uint64_t{4} << 20;
  while (count > 0) {
    const std::string bytes = read(static_cast<uint64_t>(from), std::min(count, kBuffer));
    append(file, bytes);
    from += static_cast<off_t>(bytes.size());
    advance(bytes.size());
  }
}

void FileInput::give_mode(AtomicFile& file) const {
  struct stat status = {};
  if (fstat(descriptor_, &status) == 0) {
    const int ignored = fchmod(fileno(file.stream()), status.st_mode & 0777);  // some file systems have no modes
    static_cast<void>(ignored);
  }
}

}  // namespace ods
