// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A folder for files of ours that no other user can read, or put something in the way of: the only way to make a file
// in a folder that others share. Its name cannot be guessed, and its mode is 0700.
#pragma once
#include <string>

namespace ods {

// The folder for temporary files, $TMPDIR or /tmp, which all users share. Throws Error(kOutput) if it is not a folder.
std::string temporary_folder();

// Is removed with everything in it, also by a signal handler that calls remove_unfinished_files(). The next
// PrivateFolder with that prefix removes what a killed process left.
class PrivateFolder {
 public:
  // A new folder in the temporary folder. Throws Error(kOutput).
  PrivateFolder();
  // A new folder whose path begins like this. Throws Error(kOutput).
  explicit PrivateFolder(const std::string& prefix);
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  ~PrivateFolder();

  // Absolute and without links.
  const std::string& path() const { return path_; }

  // Leaves it there, for good and under a name that can be seen, which is returned: for files that must not be lost.
  std::string keep();

 private:
  std::string path_;
  int lock_ = -1;
};

// Removes a folder and what is in it, up to 32 folders deep; follows no link. What cannot be removed stays.
// Async-signal-safe.
void remove_folder(const char* path);

}  // namespace ods
