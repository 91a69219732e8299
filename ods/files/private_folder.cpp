// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/private_folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"

namespace ods {

namespace fs = std::filesystem;

static int open_folder(int parent, const char* name) {
  return openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

static bool is_own_link(const char* name) {
  return std::strcmp(name, ".") == 0 || std::strcmp(name, "..") == 0;
}

// Closes the folder.
static void remove_content(int folder, int levels) {
  alignas(dirent64) char entries[2048];  // readdir() is not async-signal-safe
  for (bool removed = true; removed;) {  // removals during reading may hide other entries
    removed = false;
    lseek(folder, 0, SEEK_SET);
    for (long size = 0; (size = syscall(SYS_getdents64, folder, entries, sizeof(entries))) > 0;) {
      for (long at = 0; at < size;) {
        const auto* const entry = reinterpret_cast<const dirent64*>(entries + at);
        at += entry->d_reclen;
        if (is_own_link(entry->d_name)) continue;
        const int inner = levels > 0 ? open_folder(folder, entry->d_name) : -1;
        if (inner >= 0) remove_content(inner, levels - 1);
        removed |= unlinkat(folder, entry->d_name, inner >= 0 ? AT_REMOVEDIR : 0) == 0;
      }
    }
  }
  close(folder);
}

void remove_folder(const char* path) {
  const int folder = open_folder(AT_FDCWD, path);
  if (folder < 0) return;
  remove_content(folder, 32);
  rmdir(path);
}

// Returns whether a folder is ours, and no process has it locked. On a disk without locks its maker may be alive.
static bool is_left_folder(const fs::path& path) {
  const int folder = open_folder(AT_FDCWD, path.c_str());
  if (folder < 0) return false;
  struct stat info;
  const bool is_ours = fstat(folder, &info) == 0 && info.st_uid == geteuid();
  const bool is_free = is_ours && flock(folder, LOCK_EX | LOCK_NB) == 0;
  close(folder);
  return is_free;
}

// start: the common beginning of the names of all such folders of this machine; the process number follows.
static void remove_left_folders(const fs::path& parent, const std::string& start) {
  std::error_code error;
  for (fs::directory_iterator at(parent, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().native();
    if (!name.starts_with(start)) continue;
    const int process = std::atoi(name.c_str() + start.size());
    const bool is_dead = process > 0 && kill(process, 0) != 0 && errno == ESRCH;
    if (is_dead && is_left_folder(at->path())) remove_folder(at->path().c_str());
  }
}

void make_own_folder(const std::string& path) {
  const auto fail = [&](const std::string& why) {
    throw Error(ErrorKind::kOutput, fmt::format("cannot keep files in '{}': {}", path, why));
  };
  std::error_code ignored;  // opening the folder reports it
  fs::create_directories(fs::path(path).parent_path(), ignored);
  const bool is_new = mkdir(path.c_str(), S_IRWXU) == 0;
  struct stat named, found;
  const int folder = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool is_known = folder >= 0 && fstat(folder, &found) == 0 && lstat(path.c_str(), &named) == 0;
  const std::string why = std::strerror(errno);
  const bool is_ours = is_known && found.st_uid == geteuid() && named.st_uid == geteuid();
  const bool is_open = is_ours && !is_new && (found.st_mode & (S_IWGRP | S_IWOTH)) != 0;
  const bool is_closed = is_ours && !is_open && fchmod(folder, S_IRWXU) == 0;
  if (folder >= 0) close(folder);
  if (!is_known) fail(why);
  if (!is_ours) fail("it belongs to another user");
  if (is_open) fail("other users could have put files there: remove it");
  if (!is_closed) fail("its mode cannot be changed");
}

static std::string find_temporary_folder(std::error_code& error) {
  return fs::temp_directory_path(error).native();  // empty if there is an error
}

std::string temporary_folder() {
  std::error_code error;
  const std::string folder = find_temporary_folder(error);
  if (error) {
    throw Error(ErrorKind::kOutput,
                fmt::format("there is no folder for temporary files (TMPDIR): {}", error.message()));
  }
  return folder;
}

std::string temporary_folder_if_any() {
  std::error_code ignored;
  return find_temporary_folder(ignored);
}

PrivateFolder::PrivateFolder() : PrivateFolder((fs::path(temporary_folder()) / "ods-").native()) {}

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
  lock_ = open_folder(AT_FDCWD, path_.c_str());
  flock(lock_, LOCK_EX | LOCK_NB);  // some file systems have no locks
}

std::string PrivateFolder::keep() {
  forget_unfinished(path_.c_str());
  const std::string path = std::exchange(path_, "");
  const fs::path kept = fs::path(path).parent_path() / ("kept-" + path.substr(path.size() - 6));
  return std::rename(path.c_str(), kept.c_str()) == 0 ? kept.native() : path;
}

PrivateFolder::~PrivateFolder() {
  if (!path_.empty()) remove_folder(path_.c_str());
  forget_unfinished(path_.c_str());
  close(lock_);
}

}  // namespace ods
