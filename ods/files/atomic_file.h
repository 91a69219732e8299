// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Atomic writes: a file is written beside its final name, flushed to disk, then renamed,
// so a file that exists is complete.
#pragma once
#include <cstdio>
#include <list>
#include <string>
#include <string_view>

#include "ods/base/error.h"
#include "ods/files/byte_sink.h"

namespace ods {

// The Error(kOutput) "cannot write 'PATH': WHY".
Error cannot_write(const std::string& path, const std::string& why);

// Throws Error(kOutput) if a file cannot be written there: the name is a folder or a device or too long, or the folder
// (or its nearest existing ancestor) is not writable. Leaves nothing on the disk.
void check_writable(const std::string& path);

// Returns the folder of a file that need not exist, or the nearest existing ancestor of that folder. Absolute.
std::string existing_folder_of(const std::string& path);

// Until commit() the file is called `.NAME.tmp.HOST.PID.RANDOM`, and a file with the final name is untouched.
// Destruction without commit() removes it. The next AtomicFile with that name removes what a killed process left. Paths
// are bytes. A link stays, and its target is replaced, except if the link belongs to another user and is in a folder
// that all users share, such as /tmp.
class AtomicFile final : public ByteSink {
 public:
  // Creates the parent folders and the temporary file. Throws as check_writable() does, and for another user's link.
  explicit AtomicFile(const std::string& path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile() override;

  // The stream to write to. Callers need not check for write errors: finish() does.
  std::FILE* stream() const { return stream_; }
  // The stream as a sink, for encoders that may also write to memory.
  void write(const void* bytes, size_t count) override;
  void seek(uint64_t position) override;
  uint64_t position() const override { return position_; }
  const std::string& path() const override { return path_; }  // the final name
  // The temporary file, for libraries that must open it themselves.
  const std::string& temporary() const { return temporary_; }

  // Flushes to disk and closes the stream. Throws Error(kOutput): full disk, quota, lost share.
  void finish();
  // finish(), then renames to the final name. Throws Error(kOutput).
  void commit();

 private:
  std::string path_;
  std::string target_;  // path_, or the target of its link
  std::string temporary_;
  std::FILE* stream_ = nullptr;
  uint64_t position_ = 0;  // of write()
};

// Writes a whole file. Throws as AtomicFile does.
void write_file(const std::string& path, std::string_view bytes);

// Commits files that belong together: renames none until all are on disk.
void commit_all(std::list<AtomicFile>& files);

// Renames a complete file, or a folder, on the same disk, whatever the disk supports. Returns false if the name is
// taken, even by a dangling link. Throws Error(kOutput); then the old name stays.
bool rename_as_new(const std::string& from, const std::string& to);

// Removes the temporary files of this process (of those open at once, the first 16). Async-signal-safe, for a signal
// handler that ends the process.
void remove_unfinished_files();

// Adds a file, or a folder of files, to that list until forget_unfinished(). The string must stay at its address until
// then.
void remember_unfinished(const char* path);
void forget_unfinished(const char* path);

}  // namespace ods
