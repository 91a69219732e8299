// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Files named by untrusted input: only those inside one folder may be read.
#pragma once
#include <string>

namespace ods {

// Holds the file open, so that nobody can replace it between the check and the read.
class ConfinedFile {
 public:
  // folder: an absolute path without links, as std::filesystem::canonical() returns it; empty: any file is allowed.
  // Throws Error(kInput), as read_file.h. Follows every link, and throws the same error for every path outside the
  // folder, whether or not that file exists.
  ConfinedFile(const std::string& path, const std::string& folder);
  ConfinedFile(const ConfinedFile&) = delete;
  ConfinedFile& operator=(const ConfinedFile&) = delete;
  ~ConfinedFile();

  // A path to this very file, valid while the object lives. Without a folder it is the path given.
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int descriptor_ = -1;
};

}  // namespace ods
