// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/private_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;

namespace ods {
namespace {

void fill(const std::string& path, int files) {
  for (int i = 0; i < files; i++) std::ofstream(path + "/a file with a long name, number " + std::to_string(i)) << i;
}

TEST(PrivateFolder, IsForUsAloneAndGoesWithItsFiles) {
  const TemporaryFolder parent;
  {
    const PrivateFolder a(parent.path("ods-")), b(parent.path("ods-"));
    EXPECT_NE(a.path(), b.path());
    EXPECT_TRUE(a.path().starts_with(parent.path("ods-"))) << a.path();
    EXPECT_EQ(fs::status(a.path()).permissions(), fs::perms::owner_all);
    fill(a.path(), 500);
    EXPECT_EQ(parent.names().size(), 2u);
  }
  EXPECT_TRUE(parent.names().empty());
}

TEST(PrivateFolder, FollowsNoLink) {
  const TemporaryFolder parent;
  fs::create_directory(parent.path("else"));
  parent.write("else/kept", "kept");
  {
    const PrivateFolder folder(parent.path("ods-"));
    fs::create_directory_symlink(parent.path("else"), folder.path() + "/link");
  }
  fs::create_directory_symlink(parent.path("else"), parent.path("link"));
  remove_folder(parent.path("link").c_str());
  EXPECT_EQ(parent.read("else/kept"), "kept");
}

TEST(PrivateFolder, GoesWithTheFoldersInIt) {
  const TemporaryFolder parent;
  fs::create_directory(parent.path("else"));
  parent.write("else/kept", "kept");
  {
    const PrivateFolder folder(parent.path("ods-"));
    for (const char* inner : {"/blender_a", "/blender_a/deep", "/b"}) {
      fs::create_directory(folder.path() + inner);
      fill(folder.path() + inner, 40);
    }
    fs::create_directory_symlink(parent.path("else"), folder.path() + "/b/link");
  }
  EXPECT_EQ(parent.names(), std::vector<std::string>{"else"});
  EXPECT_EQ(parent.read("else/kept"), "kept");
}

// Its name has the number of a dead process, as any user could choose it.
TEST(PrivateFolder, LeavesAnotherUsersFolderAlone) {
  if (geteuid() != 0) GTEST_SKIP() << "skipped: only root can give a folder to another user";
  const TemporaryFolder parent;
  std::string name;
  {
    const PrivateFolder folder(parent.path("ods-"));
    name = fs::path(folder.path()).filename().native();
  }
  const size_t end = name.rfind('.'), begin = name.rfind('.', end - 1) + 1;
  const std::string planted = name.substr(0, begin) + "999999999" + name.substr(end);
  fs::create_directory(parent.path(planted));
  parent.write(planted + "/file", "theirs");
  ASSERT_EQ(chown(parent.path(planted).c_str(), 65534, 65534), 0);
  { const PrivateFolder folder(parent.path("ods-")); }
  EXPECT_EQ(parent.read(planted + "/file"), "theirs");
}

TEST(PrivateFolder, LiesInTheTemporaryFolder) {
  const PrivateFolder folder;
  EXPECT_EQ(fs::path(folder.path()).parent_path(), fs::canonical(temporary_folder()));
}

TEST(PrivateFolder, GoesWhenASignalEndsTheProcess) {
  const TemporaryFolder parent;
  const PrivateFolder folder(parent.path("ods-"));
  fill(folder.path(), 3);
  remove_unfinished_files();
  EXPECT_TRUE(parent.names().empty());
}

TEST(PrivateFolder, RemovesWhatAKilledProcessLeft) {
  const TemporaryFolder parent;
  const pid_t child = fork();
  if (child == 0) {
    const PrivateFolder folder(parent.path("ods-"));
    fill(folder.path(), 3);
    raise(SIGKILL);
  }
  waitpid(child, nullptr, 0);
  ASSERT_EQ(parent.names().size(), 1u);
  const std::string left = parent.names()[0];
  {
    const int file = open(parent.path(left).c_str(), O_RDONLY | O_DIRECTORY);  // as if in another container
    ASSERT_EQ(flock(file, LOCK_EX), 0);
    const PrivateFolder folder(parent.path("ods-"));
    EXPECT_EQ(parent.names().size(), 2u) << "somebody has it";
    close(file);
  }
  const PrivateFolder folder(parent.path("ods-"));
  EXPECT_EQ(parent.names().size(), 1u);
  EXPECT_FALSE(fs::exists(parent.path(left)));
}

TEST(PrivateFolder, SaysWhereItCannotBe) {
  EXPECT_THROW(PrivateFolder("/proc/ods-"), Error);
}

}  // namespace
}  // namespace ods
