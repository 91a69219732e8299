// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Files named by untrusted input: only files inside one folder may be read, or only files directly in it.
#pragma once
#include <string>

#include "ods/base/error.h"

namespace ods {

enum class Reach {
  kWithin,    // in the folder or in one below it; links may lead there
  kDirectly,  // in the folder itself, and not a link
};

// Holds the file open, so that it cannot be replaced between the check and the read.
class ConfinedFile {
 public:
  // folder: an absolute path without links, as std::filesystem::canonical() returns it; empty: any file is allowed.
  // Throws Error(kInput), as read_file.h does. Resolves every link, and throws the same error for every path that is
  // not allowed, whether or not that file exists.
  ConfinedFile(const std::string& path, const std::string& folder, Reach reach = Reach::kWithin);
  ConfinedFile(const ConfinedFile&) = delete;
  ConfinedFile& operator=(const ConfinedFile&) = delete;
  ~ConfinedFile();

  // Returns read(path), where the path leads to this very file. Errors that `read` throws name the file as it was
  // given.
  template <typename Read>
  auto read(const Read& read) const {
    try {
      return read(opened_);
    } catch (const Error& error) {
      throw Error(error.kind(), with_given_path(error.what()));
    }
  }

 private:
  std::string with_given_path(std::string text) const;

  std::string path_;    // as given
  std::string opened_;  // of the descriptor; without a folder as given
  int descriptor_ = -1;
};

}  // namespace ods
