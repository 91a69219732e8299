// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "ods/base/error.h"
#include "ods/files/private_folder.h"

namespace ods {

namespace fs = std::filesystem;

Error cannot_write(const std::string& path, const std::string& why) {
  return Error(ErrorKind::kOutput, fmt::format("cannot write '{}': {}", path, why));
}

static fs::path folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

// The names of temporary files, readable from a signal handler. The strings outlive their entries.
static std::array<std::atomic<const char*>, 16> unfinished{};
static_assert(std::atomic<const char*>::is_always_lock_free);

static void replace_unfinished(const char* old_name, const char* new_name) {
  for (std::atomic<const char*>& entry : unfinished) {
    const char* expected = old_name;
    if (entry.compare_exchange_strong(expected, new_name)) return;
  }
}

void remember_unfinished(const char* path) {
  replace_unfinished(nullptr, path);
}

void forget_unfinished(const char* path) {
  replace_unfinished(path, nullptr);
}

static void forget(std::string& temporary) {
  forget_unfinished(temporary.c_str());
  temporary.clear();
}

static void remove_temporary(std::string& temporary) {
  std::remove(temporary.c_str());
  forget(temporary);
}

void remove_unfinished_files() {
  for (const std::atomic<const char*>& entry : unfinished) {
    const char* name = entry;
    if (name != nullptr && unlink(name) != 0 && errno == EISDIR) remove_folder(name);
  }
}

// The common prefix of this machine's temporary names for a file, up to the process number; shortened because a name
// has at most 255 bytes.
static std::string temporary_prefix(const std::string& path) {
  char host[64] = "";
  gethostname(host, sizeof(host) - 1);
  return fmt::format(".{}.tmp.{}.", fs::path(path).filename().native().substr(0, 120), host);
}

// Creates a file with a new name that cannot be guessed, locked while it is open. Null, with errno set, on failure.
static std::FILE* create_temporary(const fs::path& folder, const std::string& path, std::string& temporary) {
  const std::string prefix = temporary_prefix(path);
  const int kTries = 100;
  std::FILE* stream = nullptr;
  for (int i = 0; i < kTries; i++) {
    uint64_t number = 0;
    if (getrandom(&number, sizeof(number), 0) != sizeof(number)) break;
    temporary = folder / fmt::format("{}{}.{:016x}", prefix, getpid(), number);
    replace_unfinished(nullptr, temporary.c_str());  // before it exists, so that no signal falls between
    stream = std::fopen(temporary.c_str(), "wbxe");
    if (stream != nullptr) break;
    const int why = errno;
    forget(temporary);
    errno = why;
    if (why != EEXIST) break;
  }
  if (stream != nullptr) flock(fileno(stream), LOCK_EX | LOCK_NB);  // some file systems have no locks
  return stream;
}

// No process has it open. The lock also detects processes in other containers, which have other process numbers.
static bool is_left_alone(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) return false;
  const bool is_free = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  close(descriptor);
  return is_free;
}

// Removes the temporary files that killed processes left of this file.
static void remove_leftovers(const fs::path& folder, const std::string& path) {
  const std::string prefix = temporary_prefix(path);
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().native();
    if (!name.starts_with(prefix)) continue;
    const int process = std::atoi(name.c_str() + prefix.size());
    const bool is_dead = process > 0 && kill(process, 0) != 0 && errno == ESRCH;
    if (is_dead && is_left_alone(at->path())) unlink(at->path().c_str());
  }
}

std::string existing_folder_of(const std::string& path) {
  std::error_code ignored;
  fs::path folder = fs::absolute(path, ignored).parent_path();
  while (!fs::is_directory(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
  return folder.native();
}

void check_writable(const std::string& path) {
  std::error_code error, ignored;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::none) throw cannot_write(path, error.message());
  if (fs::is_directory(status) || fs::path(path).filename().empty()) {
    throw cannot_write(path, "it is a folder; add a file name");
  }
  // Renaming over a device or a pipe would replace it.
  if (fs::exists(status) && !fs::is_regular_file(status)) throw cannot_write(path, "it is not an ordinary file");

  fs::path folder = folder_of(path);
  while (!fs::exists(folder, ignored) && folder.has_relative_path()) {
    folder = folder.has_parent_path() ? folder.parent_path() : fs::path(".");
  }
  if (!fs::is_directory(folder, ignored))
    throw cannot_write(path, fmt::format("'{}' is not a folder", folder.native()));
  // Only an attempt shows it: root's permissions allow writing anywhere, but /proc cannot be written.
  std::string temporary;
  std::FILE* stream = create_temporary(folder, path, temporary);
  if (stream == nullptr) {
    throw cannot_write(path, fmt::format("folder '{}': {}", folder.native(), std::strerror(errno)));
  }
  std::fclose(stream);
  remove_temporary(temporary);
}

// Returns whether Linux itself would follow a link (fs.protected_symlinks): in a folder where all users may leave
// files, only a link of ours or of the folder's owner.
static bool may_follow(const fs::path& link) {
  struct stat own, folder;
  if (lstat(link.c_str(), &own) != 0 || stat(folder_of(link.native()).c_str(), &folder) != 0) return false;
  const bool is_shared = (folder.st_mode & S_ISVTX) && (folder.st_mode & S_IWOTH);
  return !is_shared || own.st_uid == geteuid() || own.st_uid == folder.st_uid;
}

// Follows links, so that the link stays and its target is replaced.
static std::string behind_links(const std::string& path) {
  const int kMaxLinks = 40;  // as Linux has it
  fs::path target = path;
  std::error_code error;
  for (int i = 0; i < kMaxLinks && fs::is_symlink(target, error); i++) {
    if (!may_follow(target)) throw cannot_write(path, "it is another user's link; choose another name");
    target = target.parent_path() / fs::read_symlink(target, error);  // an absolute one replaces the folder
  }
  return target.native();
}

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(behind_links(path)) {
  check_writable(target_);
  std::error_code error;
  fs::create_directories(folder_of(target_), error);
  if (error) throw cannot_write(path, fmt::format("folder cannot be made: {}", error.message()));
  remove_leftovers(folder_of(target_), target_);
  stream_ = create_temporary(folder_of(target_), target_, temporary_);
  if (stream_ == nullptr) throw cannot_write(path, std::strerror(errno));
}

AtomicFile::~AtomicFile() {
  if (stream_ != nullptr) std::fclose(stream_);
  if (!temporary_.empty()) remove_temporary(temporary_);
}

void AtomicFile::write(const void* bytes, size_t count) {
  std::fwrite(bytes, 1, count, stream_);
  position_ += count;
}

void AtomicFile::seek(uint64_t position) {
  if (fseeko(stream_, static_cast<off_t>(position), SEEK_SET) == 0) position_ = position;
}

void AtomicFile::finish() {
  if (stream_ == nullptr) return;
  errno = 0;
  const bool written = std::fflush(stream_) == 0 && std::ferror(stream_) == 0 && fsync(fileno(stream_)) == 0;
  const int flush_error = errno;
  const bool closed = std::fclose(stream_) == 0;
  const int close_error = errno;
  stream_ = nullptr;
  if (written && closed) return;
  remove_temporary(temporary_);  // so that no later commit() can publish a part
  const int code = written ? close_error : flush_error;
  throw cannot_write(path_, code == 0 ? "the disk is full or was lost" : std::strerror(code));
}

void AtomicFile::commit() {
  finish();
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) throw cannot_write(path_, std::strerror(errno));
  forget(temporary_);
}

void write_file(const std::string& path, std::string_view bytes) {
  AtomicFile file(path);
  std::fwrite(bytes.data(), 1, bytes.size(), file.stream());
  file.commit();
}

// An empty file, or folder, of ours takes the name first: replacing it loses nothing.
static bool rename_over_own(const std::string& from, const std::string& to) {
  std::error_code error;
  const bool is_folder = fs::is_directory(from, error);
  const int made =
      is_folder ? mkdir(to.c_str(), 0777) : open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (made < 0) return false;
  if (!is_folder) close(made);
  if (std::rename(from.c_str(), to.c_str()) == 0) return true;
  const int why = errno;
  std::remove(to.c_str());
  errno = why;
  return false;
}

bool rename_as_new(const std::string& from, const std::string& to) {
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno == EEXIST) return false;
  if (errno != EINVAL && errno != ENOSYS && errno != EPERM && errno != EOPNOTSUPP) {
    throw cannot_write(to, std::strerror(errno));
  }
  // Network shares do not support this. A hard link does not replace anything either, but some shares and all folders
  // lack hard links.
  if (link(from.c_str(), to.c_str()) == 0) return unlink(from.c_str()) == 0;
  if (errno == EEXIST) return false;
  if (rename_over_own(from, to)) return true;
  if (errno == EEXIST) return false;
  throw cannot_write(to, std::strerror(errno));
}

void commit_all(std::list<AtomicFile>& files) {
  for (AtomicFile& file : files) file.finish();
  for (AtomicFile& file : files) file.commit();
}

}  // namespace ods
