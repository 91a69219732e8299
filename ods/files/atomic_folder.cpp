// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/atomic_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"

namespace ods {

namespace fs = std::filesystem;

// Exchanges two folders like renameat2() with RENAME_EXCHANGE, for disks that lack it. In between the old folder has a
// name that no process removes.
static bool swap_folders(const std::string& old, const std::string& draft) {
  std::string between = old + ".old-XXXXXX";
  if (!mkdtemp(between.data())) return false;
  if (std::rename(old.c_str(), between.c_str()) == 0) {
    if (std::rename(draft.c_str(), old.c_str()) == 0) return std::rename(between.c_str(), draft.c_str()) == 0;
    const int why = errno;
    std::rename(between.c_str(), old.c_str());
    errno = why;
    return false;
  }
  const int why = errno;
  rmdir(between.c_str());
  errno = why;
  return false;
}

static bool is_mount_point(const std::string& folder) {
  struct stat own = {}, parent = {};
  return stat(folder.c_str(), &own) == 0 && stat((folder + "/..").c_str(), &parent) == 0 && own.st_dev != parent.st_dev;
}

AtomicFolder::AtomicFolder(const std::string& path) : path_(path) {
  std::error_code error;
  fs::path target = fs::weakly_canonical(fs::absolute(path), error);
  if (target.filename().empty()) target = target.parent_path();  // "site/"
  target_ = target.native();
  const fs::file_status status = fs::status(target, error);
  if (fs::exists(status) && !fs::is_directory(status)) throw cannot_write(path, "it is not a folder");
  const bool exists = fs::is_directory(status);
  is_inside_ = exists && (is_mount_point(target_) || fs::equivalent(target, fs::current_path(error), error));
  const std::string inside = target_ + "/.new-";
  const std::string beside = existing_folder_of(target_) + "/." + target.filename().native().substr(0, 100) + "-";
  try {
    private_ = std::make_unique<PrivateFolder>(is_inside_ ? inside : beside);
  } catch (const Error&) {
    if (!exists || is_inside_) throw;
    private_ = std::make_unique<PrivateFolder>(inside);
    is_inside_ = true;
  }
  draft_ = private_->path() + "/new";
  if (!fs::create_directory(draft_, error)) throw cannot_write(path, error.message());
}

// Every file that the draft lacks gets a second name there: whatever happens, it keeps its first one.
void AtomicFolder::keep_others() const {
  const auto check = [&](const std::error_code& error) {
    if (error) throw cannot_write(path_, error.message());
  };
  std::error_code error;
  fs::recursive_directory_iterator at(target_, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    const fs::path copy = fs::path(draft_) / fs::path(at->path()).lexically_relative(target_);
    const bool is_folder = fs::is_directory(at->symlink_status());
    if (fs::exists(fs::symlink_status(copy))) {
      if (is_folder && !fs::is_directory(fs::symlink_status(copy))) at.disable_recursion_pending();
      continue;
    }
    if (is_folder) {
      fs::create_directory(copy, at->path(), error);
    } else if (fs::is_symlink(at->symlink_status())) {
      fs::copy_symlink(at->path(), copy, error);
    } else {
      fs::create_hard_link(at->path(), copy, error);
      if (error && fs::is_regular_file(at->symlink_status())) fs::copy_file(at->path(), copy, error);
    }
    check(error);
  }
  check(error);
  fs::permissions(draft_, fs::status(target_, error).permissions(), error);
}

bool AtomicFolder::exchange() const {
  if (renameat2(AT_FDCWD, draft_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS && errno != EPERM && errno != EOPNOTSUPP) return false;
  return swap_folders(target_, draft_);
}

void AtomicFolder::move_files() const {
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(draft_, error)) {
    const fs::path relative = entry.path().lexically_relative(draft_);
    if (entry.is_directory(error)) {
      fs::create_directories(fs::path(target_) / relative, error);
    } else {
      files.emplace_back(entry.last_write_time(error), relative);
    }
  }
  std::ranges::stable_sort(files, {}, [](const auto& file) { return file.first; });
  for (const auto& [time, relative] : files) {
    fs::rename(fs::path(draft_) / relative, fs::path(target_) / relative, error);
    if (error) throw cannot_write((fs::path(path_) / relative).native(), error.message());
  }
}

void AtomicFolder::commit() {
  if (is_inside_) return move_files();
  std::error_code error;
  fs::create_directories(fs::path(target_).parent_path(), error);
  const bool exists = fs::is_directory(target_, error);
  if (exists) keep_others();
  if (exists ? exchange() : rename_as_new(draft_, target_)) return;
  throw cannot_write(path_, exists ? std::strerror(errno) : "it was made by another program meanwhile");
}

}  // namespace ods
