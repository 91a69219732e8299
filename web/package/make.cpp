// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// make_web_package WEB_PACKAGE FOLDER: writes the package for npm (ods/view/package.h), for `npm pack` or a web host.
#include <filesystem>
#include <iostream>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "ods/view/package.h"

int main(int count, char** words) {
  if (count != 3) return 2;
  try {
    for (const auto& [name, text] : ods::package_files(words[1])) {
      const std::filesystem::path path = std::filesystem::path(words[2]) / name;
      std::filesystem::create_directories(path.parent_path());
      ods::write_file(path.native(), text);
    }
  } catch (const std::exception& error) {
    std::cerr << "make_web_package: " << error.what() << '\n';
    return 1;
  }
}
