// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The project's own sources, as text.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/places.h"

namespace ods {

struct Source {
  std::string path;  // from the root of the tree
  std::vector<std::string> lines;
  bool is_header() const { return path.ends_with(".h"); }
};

inline std::vector<std::string> read_lines(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

inline std::vector<Source> read_sources(const std::vector<std::string>& folders) {
  const std::filesystem::path root = source_folder();
  std::vector<Source> sources;
  for (const std::string& folder : folders) {
    if (!std::filesystem::exists(root / folder)) continue;
    for (const std::filesystem::directory_entry& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".cpp" && extension != ".h") continue;
      sources.push_back({std::filesystem::relative(entry.path(), root).generic_string(), read_lines(entry.path())});
    }
  }
  EXPECT_GT(sources.size(), 10u);
  return sources;
}

inline const std::vector<Source>& all_sources() {
  static const std::vector<Source> sources = read_sources({"ods", "cli", "tests", "bench", "fuzz", "examples"});
  return sources;
}

}  // namespace ods
