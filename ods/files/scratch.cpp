// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/scratch.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/files/atomic_file.h"

namespace ods {

static Error no_room(const std::string& folder, size_t size, int code) {
  return Error(ErrorKind::kOutput, fmt::format("cannot keep {} of pixels in '{}': {}; write to another disk",
                                               bytes_text(size), folder, std::strerror(code)));
}

// Not every file system supports files without a name.
static int open_unlinked(const std::string& folder) {
  const int file = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file >= 0) return file;
  std::string name = folder + "/.ods-scratch-XXXXXX";
  const int named = mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) unlink(name.c_str());
  return named;
}

// Allocates every block before mapping: a write to the mapping on a full disk would kill the process.
static void* map_file(const std::string& folder, size_t size) {
  const int file = open_unlinked(folder);
  if (file < 0) throw no_room(folder, size, errno);
  int code = posix_fallocate(file, 0, static_cast<off_t>(size));
  void* map = MAP_FAILED;
  if (code == 0) {
    map = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (map == MAP_FAILED) code = errno;
  }
  close(file);
  if (map == MAP_FAILED) throw no_room(folder, size, code);
  return map;
}

// The reason why an open file cannot be used; empty if it can. An empty file was left by a killed process.
static std::string fault_of(int file, std::string_view mark) {
  struct stat info;
  if (fstat(file, &info) != 0) return std::strerror(errno);
  if (!S_ISREG(info.st_mode)) return "it is not an ordinary file";
  if (info.st_uid != geteuid() && geteuid() != 0) return "it is another user's; remove it, or write to another folder";
  std::string start(mark.size(), '\0');
  const bool has_mark = pread(file, start.data(), start.size(), 0) == std::ssize(mark) && start == mark;
  return has_mark || info.st_size == 0
             ? ""
             : "ods needs that name for its work, and this file is not its own; rename or remove it";
}

// Locks the file. Does not touch its contents.
static int open_marked(const std::string& path, std::string_view mark) {
  int file = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0 && errno == EEXIST) file = open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) throw cannot_write(path, errno == ELOOP ? "it is a link; remove it" : std::strerror(errno));
  const bool is_busy = flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;  // not every disk has locks
  const std::string fault = is_busy ? "" : fault_of(file, mark);
  if (!is_busy && fault.empty()) return file;
  close(file);
  if (is_busy) throw Error(ErrorKind::kOutput, fmt::format("another ods is at work on '{}'", path));
  throw cannot_write(path, fault);
}

// Unless the file has the right size already, clears it to zeros after the mark.
static int make_room(int file, off_t length, std::string_view mark) {
  struct stat info;
  if (fstat(file, &info) != 0) return errno;
  if (info.st_size != length) {
    if (ftruncate(file, 0) != 0) return errno;
    if (pwrite(file, mark.data(), mark.size(), 0) != std::ssize(mark)) return errno == 0 ? ENOSPC : errno;
  }
  return posix_fallocate(file, 0, length);
}

// Allocated on the heap, which reuses the pages of freed pictures.
static void* allocate(size_t size) {
  check_memory(size, "the picture", "use a machine with more, or a smaller picture");
  void* memory = std::calloc(size, 1);
  if (!memory) throw Error(ErrorKind::kMemory, fmt::format("the picture needs {} of memory", bytes_text(size)));
  return memory;
}

Scratch::Scratch(size_t size, const std::string& folder, size_t max_in_memory)
    : size_(std::max<size_t>(size, 1)), on_disk_(size > max_in_memory && !folder.empty()) {
  data_ = static_cast<std::byte*>(on_disk_ ? map_file(folder, size_) : allocate(size_));
}

Scratch::Scratch(size_t size, const std::string& file, std::string_view mark)
    : size_(std::max<size_t>(size, 1)), on_disk_(true), file_(open_marked(file, mark)) {
  errno = 0;
  int code = make_room(file_, static_cast<off_t>(size_), mark);
  void* map = MAP_FAILED;
  if (code == 0) {
    map = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
    if (map == MAP_FAILED) code = errno;
  }
  if (map == MAP_FAILED) {
    if (code == ENOSPC) unlink(file.c_str());
    close(file_);
    throw no_room(file, size, code);
  }
  data_ = static_cast<std::byte*>(map);
}

Scratch::~Scratch() {
  on_disk_ ? static_cast<void>(munmap(data_, size_)) : std::free(data_);
  if (file_ >= 0) close(file_);
}

void Scratch::release() const {
  if (on_disk_) madvise(data_, size_, MADV_DONTNEED);
}

}  // namespace ods
