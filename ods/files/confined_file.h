// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Files that strangers name: only those in one folder may be read.
#pragma once
#include <string>

namespace ods {

// A file held open, so that nobody can put another one in its place between the check and the reading.
class ConfinedFile {
 public:
  // folder: an absolute path without links, as std::filesystem::canonical() returns it; empty: any file will do.
  // Throws Error(kInput), as read_file.h. It throws the same for all that lies outside of the folder once every link in
  // the path is followed, whether it is there or not.
  ConfinedFile(const std::string& path, const std::string& folder);
  ConfinedFile(const ConfinedFile&) = delete;
  ConfinedFile& operator=(const ConfinedFile&) = delete;
  ~ConfinedFile();

  // A path that leads to this very file as long as the object is there. Without a folder it is the one given.
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int descriptor_ = -1;
};

}  // namespace ods
