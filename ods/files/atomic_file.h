// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A file that exists is complete: it is written beside its final name, flushed to the disk, then renamed.
#pragma once
#include <cstdio>
#include <list>
#include <string>
#include <string_view>

namespace ods {

// Throws Error(kOutput) when a file could not be written there: the name is a folder or a device or too long, no file
// can be made in the folder (or the nearest one that exists above it). Leaves nothing on the disk.
void check_writable(const std::string& path);

// Until commit() the file is called `.NAME.tmp.HOST.PID.N`, and whatever stood under the final name is untouched;
// destruction without commit() removes it, and the next of that name what a killed process left. Paths are bytes.
class AtomicFile {
 public:
  // Creates the folders above the file and the file under its temporary name. Throws as check_writable().
  explicit AtomicFile(const std::string& path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  // Where to write. A failed write need not be noticed by who made it: finish() does.
  std::FILE* stream() const { return stream_; }
  const std::string& path() const { return path_; }  // the final name
  // The same file for libraries that insist on opening it themselves.
  const std::string& temporary() const { return temporary_; }

  // Everything is on the disk, or Error(kOutput) (full disk, quota, lost share). Closes the stream.
  void finish();
  // finish(), then the final name. Throws Error(kOutput).
  void commit();

 private:
  std::string path_;
  std::string target_;  // path_, or what it links to
  std::string temporary_;
  std::FILE* stream_ = nullptr;
};

// A whole file of these bytes. Throws as AtomicFile.
void write_file(const std::string& path, std::string_view bytes);

// Files that belong together: none gets its final name before the last one is on the disk.
void commit_all(std::list<AtomicFile>& files);

// Removes every temporary file that this process has at this moment. For a signal handler that ends the process:
// async-signal-safe. (Of files open at once it knows the first 16.)
void remove_unfinished_files();

// Has it remove one more file, until that is forgotten. The name must stay where it is in memory until then.
void remember_unfinished(const char* path);
void forget_unfinished(const char* path);

}  // namespace ods
