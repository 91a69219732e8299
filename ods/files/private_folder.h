// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A folder whose files other users can neither read nor replace: the only way to make a file in a shared folder. Its
// name cannot be guessed, and its mode is 0700.
#pragma once
#include <string>

namespace ods {

// The folder for temporary files, $TMPDIR or /tmp, which all users share. Throws Error(kOutput) if it is not a folder.
std::string temporary_folder();
// Returns the same folder, or an empty string in place of the error.
std::string temporary_folder_if_any();

// The destructor removes the folder with everything in it, and so does a signal handler that calls
// remove_unfinished_files(). The next PrivateFolder with that prefix removes the folder of a killed process.
class PrivateFolder {
 public:
  // Makes a new folder in the temporary folder. Throws Error(kOutput).
  PrivateFolder();
  // Makes a new folder whose path begins with `prefix`. Throws Error(kOutput).
  explicit PrivateFolder(const std::string& prefix);
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  ~PrivateFolder();

  // Absolute and without links.
  const std::string& path() const { return path_; }

  // Keeps the folder permanently, under a visible name, which is returned: for files that must not be lost.
  std::string keep();

 private:
  std::string path_;
  int lock_ = -1;
};

// Makes a folder that persists between runs, for this user's files only, with mode 0700. Throws Error(kOutput) if
// it cannot be made, if it or the link to it belongs to another user, or if other users could write in it.
void make_own_folder(const std::string& path);

// Removes a folder and its contents, up to 32 folders deep, without following links. Leaves files that cannot be
// removed. Async-signal-safe.
void remove_folder(const char* path);

}  // namespace ods
