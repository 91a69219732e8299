// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Folders for one test.
#pragma once
#include <sys/mount.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace ods {

// An empty folder that is removed with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "ods-test-XXXXXX").native();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    root_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(root_, ignored);
  }

  std::string path(const std::string& name) const { return root_ + "/" + name; }

  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
  }

  std::string read(const std::string& name) const {
    std::ifstream stream(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  // All names in it, sorted.
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& entry : std::filesystem::directory_iterator(root_)) {
      result.push_back(entry.path().filename().native());
    }
    std::sort(result.begin(), result.end());
    return result;
  }

 private:
  std::string root_;
};

// A disk of 256 KiB, if the machine allows mounting one.
class TinyDisk {
 public:
  TinyDisk() { mounted_ = mount("ods", folder_.path("").c_str(), "tmpfs", 0, "size=256k") == 0; }
  TinyDisk(const TinyDisk&) = delete;
  TinyDisk& operator=(const TinyDisk&) = delete;
  ~TinyDisk() {
    if (mounted_) umount(folder_.path("").c_str());
  }

  bool mounted() const { return mounted_; }
  const TemporaryFolder& folder() const { return folder_; }
  void fill() const { folder_.write("ballast", std::string(1 << 20, 'x')); }

 private:
  TemporaryFolder folder_;
  bool mounted_ = false;
};

}  // namespace ods
