// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/confined_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "ods/files/read_file.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;

namespace ods {
namespace {

class Confined : public ::testing::Test {
 protected:
  Confined() {
    for (const char* name : {"in", "out"}) fs::create_directory(folder.path(name));
    folder.write("in/a", "inside");
    folder.write("out/a", "outside");
    within = fs::canonical(folder.path("in")).native();
  }

  // Lets the link lead elsewhere.
  void link(const std::string& target) {
    fs::create_symlink(folder.path(target), folder.path("new"));
    fs::rename(folder.path("new"), folder.path("in/link"));
  }

  static std::string text(const std::string& path) {
    const std::vector<unsigned char> bytes = read_file(path, 100);
    return {bytes.begin(), bytes.end()};
  }

  std::string error_of(const std::string& path) {
    try {
      ConfinedFile(path, within).read(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder;
  std::string within;
};

TEST_F(Confined, WhatWasCheckedIsRead) {
  link("in/a");
  const ConfinedFile file(folder.path("in/link"), within);
  link("out/a");
  EXPECT_EQ(file.read(text), "inside");
  EXPECT_NE(error_of(folder.path("in/link")).find("it is outside"), std::string::npos);
}

TEST_F(Confined, DirectlyIsNeitherBelowNorALink) {
  fs::create_directory(folder.path("in/below"));
  folder.write("in/below/a", "below");
  link("in/a");
  EXPECT_EQ(ConfinedFile(folder.path("in/a"), within, Reach::kDirectly).read(text), "inside");
  for (const char* name : {"in/below/a", "in/link", "out/a", "in/none"}) {
    EXPECT_THROW(ConfinedFile(folder.path(name), within, Reach::kDirectly), Error) << name;
  }
}

TEST_F(Confined, WithoutAFolderAnyFileIsRead) {
  EXPECT_EQ(ConfinedFile(folder.path("out/a"), "").read(text), "outside");
}

TEST_F(Confined, ErrorsNameTheFileAsItWasGiven) {
  const std::string path = folder.path("in/a");
  const ConfinedFile file(path, within);
  const auto fail = [](const std::string& opened) { throw cannot_read(opened, "'" + opened + "' is no picture"); };
  try {
    file.read(fail);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_EQ(error.what(), "cannot read '" + path + "': '" + path + "' is no picture");
  }
}

TEST_F(Confined, OutsideNothingShowsWhetherItExists) {
  for (const char* name : {"out/a", "out/absent"}) {
    EXPECT_EQ(error_of(folder.path(name)), "cannot read '" + folder.path(name) + "': it is outside '" + within + "'");
  }
}

}  // namespace
}  // namespace ods
