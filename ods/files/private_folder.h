// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A folder for files of ours that nobody else may read, or put something in the way of.
#pragma once
#include <string>

namespace ods {

// Is removed with its files, also by a signal handler that calls remove_unfinished_files(). The next PrivateFolder with
// that prefix removes what a killed process left.
class PrivateFolder {
 public:
  // A new folder whose path begins like this. Throws Error(kOutput).
  explicit PrivateFolder(const std::string& prefix);
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  ~PrivateFolder();

  // Absolute and without links.
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int lock_ = -1;
};

// Removes a folder and the files in it; what is not ours to remove, and other folders, stay. Async-signal-safe.
void remove_folder_of_files(const char* path);

}  // namespace ods
