// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Atomic writes of a folder: its files are written into a draft beside it, which then takes its place as a whole.
#pragma once
#include <memory>
#include <string>

#include "ods/files/private_folder.h"

namespace ods {

// Until commit() the folder is untouched, or absent. Destruction without commit() removes the draft, as does a signal
// handler that calls remove_unfinished_files().
class AtomicFolder {
 public:
  // Makes the draft. Throws Error(kOutput): the path is not a folder, or nothing can be written there.
  explicit AtomicFolder(const std::string& path);

  // The draft, empty at first. Messages replace this path, with which the paths of all files written here begin, by
  // path().
  const std::string& draft() const { return draft_; }
  const std::string& path() const { return path_; }

  // Replaces the files of the folder that are also in the draft; others stay. Throws Error(kOutput); then the folder is
  // unchanged. A folder that is a mount point, the current folder, or in a folder where we may not write cannot be
  // exchanged: its files are replaced one after the other, in the order in which they were written.
  void commit();

 private:
  void keep_others() const;
  bool exchange() const;
  void move_files() const;

  std::string path_;
  std::string target_;  // path_ without links, absolute
  std::unique_ptr<PrivateFolder> private_;
  std::string draft_;
  bool is_inside_ = false;  // the draft is in the folder
};

}  // namespace ods
