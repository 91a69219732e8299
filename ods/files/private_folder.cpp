// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/private_folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"

namespace ods {

namespace fs = std::filesystem;

static int open_folder(const char* path) {
  return open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

void remove_folder_of_files(const char* path) {
  const int folder = open_folder(path);
  if (folder < 0) return;
  alignas(dirent64) char entries[4096];  // readdir() is not async-signal-safe
  for (bool removed = true; removed;) {  // what is removed while one reads may hide others
    removed = false;
    lseek(folder, 0, SEEK_SET);
    for (long size = 0; (size = syscall(SYS_getdents64, folder, entries, sizeof(entries))) > 0;) {
      for (long at = 0; at < size;) {
        const auto* const entry = reinterpret_cast<const dirent64*>(entries + at);
        removed |= unlinkat(folder, entry->d_name, 0) == 0;
        at += entry->d_reclen;
      }
    }
  }
  close(folder);
  rmdir(path);
}

// Whoever made it is dead: nobody has it locked. Without locks it may be alive.
static bool is_unlocked(const fs::path& path) {
  const int folder = open_folder(path.c_str());
  if (folder < 0) return false;
  const bool is_free = flock(folder, LOCK_EX | LOCK_NB) == 0;
  close(folder);
  return is_free;
}

// start: what the names of all such folders of this machine have in common; the process follows.
static void remove_left_folders(const fs::path& parent, const std::string& start) {
  std::error_code error;
  for (fs::directory_iterator at(parent, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().native();
    if (!name.starts_with(start)) continue;
    const int process = std::atoi(name.c_str() + start.size());
    const bool is_dead = process > 0 && kill(process, 0) != 0 && errno == ESRCH;
    if (is_dead && is_unlocked(at->path())) remove_folder_of_files(at->path().c_str());
  }
}

PrivateFolder::PrivateFolder(const std::string& prefix) {
  char host[64] = "";
  gethostname(host, sizeof(host) - 1);
  std::error_code error;
  const fs::path start = fs::weakly_canonical(fs::absolute(prefix), error);
  const std::string all = fmt::format("{}{}.", start.filename().native(), host);
  remove_left_folders(start.parent_path(), all);
  path_ = start.parent_path() / fmt::format("{}{}.XXXXXX", all, getpid());
  if (!mkdtemp(path_.data())) {
    throw Error(ErrorKind::kOutput,
                fmt::format("cannot write in '{}': {}", start.parent_path().native(), std::strerror(errno)));
  }
  remember_unfinished(path_.c_str());
  lock_ = open_folder(path_.c_str());
  flock(lock_, LOCK_EX | LOCK_NB);  // some file systems have no locks
}

PrivateFolder::~PrivateFolder() {
  remove_folder_of_files(path_.c_str());
  forget_unfinished(path_.c_str());
  close(lock_);
}

}  // namespace ods
