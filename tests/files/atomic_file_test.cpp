// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <set>

#include "cli/console/interrupt.h"
#include "ods/base/error.h"
#include "tests/support/poor_disk.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

TEST(AtomicFile, AppearsCompleteAndReplaces) {
  const TemporaryFolder folder;
  folder.write("a.txt", "old");
  AtomicFile file(folder.path("a.txt"));
  std::fputs("new", file.stream());
  EXPECT_EQ(folder.read("a.txt"), "old");
  file.commit();
  EXPECT_EQ(folder.read("a.txt"), "new");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
}

TEST(AtomicFile, WritesWhatALinkStandsFor) {
  const TemporaryFolder folder;
  folder.write("a.txt", "old");
  std::filesystem::create_symlink("a.txt", folder.path("link.txt"));
  std::filesystem::create_symlink("new.txt", folder.path("dangling.txt"));
  for (const char* name : {"link.txt", "dangling.txt"}) {
    AtomicFile file(folder.path(name));
    std::fputs("new", file.stream());
    file.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path(name)));
  }
  EXPECT_EQ(folder.read("a.txt"), "new");
  EXPECT_EQ(folder.read("new.txt"), "new");
}

TEST(AtomicFile, FollowsNoLinkOfAnotherUserInASharedFolder) {
  if (geteuid() != 0) GTEST_SKIP() << "skipped: only root can give a link to another user";
  const TemporaryFolder folder;
  folder.write("precious", "PRECIOUS");
  std::filesystem::create_directory(folder.path("shared"));
  ASSERT_EQ(chmod(folder.path("shared").c_str(), 01777), 0);
  std::filesystem::create_symlink("../precious", folder.path("shared/link"));
  ASSERT_EQ(lchown(folder.path("shared/link").c_str(), 65534, 65534), 0);
  EXPECT_THROW(AtomicFile(folder.path("shared/link")), Error);
  EXPECT_EQ(folder.read("precious"), "PRECIOUS");
  ASSERT_EQ(lchown(folder.path("shared/link").c_str(), geteuid(), getegid()), 0);
  write_file(folder.path("shared/link"), "own");
  EXPECT_EQ(folder.read("precious"), "own");
}

// A file under a name that can be guessed could be there already.
TEST(AtomicFile, UnfinishedNamesCannotBeGuessed) {
  const TemporaryFolder folder;
  std::set<std::string> numbers;
  for (int i = 0; i < 3; i++) {
    const AtomicFile file(folder.path("a"));
    const std::string& name = file.temporary();
    numbers.insert(name.substr(name.rfind('.') + 1));
    EXPECT_EQ(numbers.rbegin()->size(), 16u);
  }
  EXPECT_EQ(numbers.size(), 3u);
}

class NewNames : public ::testing::TestWithParam<bool> {
 protected:
  NewNames() { poor_disk = GetParam(); }
  ~NewNames() override { poor_disk = false; }
};
INSTANTIATE_TEST_SUITE_P(OnDisks, NewNames, ::testing::Bool(),
                         [](const auto& each) { return each.param ? "WithoutLinks" : "WithLinks"; });

TEST_P(NewNames, ReplaceNothing) {
  const TemporaryFolder folder;
  folder.write("a.txt", "a");
  folder.write("old.txt", "old");
  std::filesystem::create_symlink("nowhere", folder.path("dangling.txt"));
  std::filesystem::create_directory(folder.path("folder"));
  for (const char* taken : {"old.txt", "dangling.txt", "folder"}) {
    EXPECT_FALSE(rename_as_new(folder.path("a.txt"), folder.path(taken))) << taken;
  }
  EXPECT_TRUE(rename_as_new(folder.path("a.txt"), folder.path("new.txt")));
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"dangling.txt", "folder", "new.txt", "old.txt"}));
  EXPECT_EQ(folder.read("new.txt") + folder.read("old.txt"), "aold");
  EXPECT_THROW(rename_as_new(folder.path("none.txt"), folder.path("b.txt")), Error);
  EXPECT_TRUE(rename_as_new(folder.path("folder"), folder.path("other")));
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"dangling.txt", "new.txt", "old.txt", "other"}));
}

TEST(AtomicFile, LeavesNothingWithoutCommit) {
  const TemporaryFolder folder;
  {
    AtomicFile file(folder.path("a.txt"));
    std::fputs("half", file.stream());
    EXPECT_EQ(folder.names().size(), 1u);
  }
  {
    AtomicFile file(folder.path("a.txt"));
    file.finish();
  }
  EXPECT_TRUE(folder.names().empty());
}

TEST(AtomicFile, SeveralAppearTogether) {
  const TemporaryFolder folder;
  std::list<AtomicFile> files;
  for (const char* name : {"left", "right"}) std::fputs(name, files.emplace_back(folder.path(name)).stream());
  commit_all(files);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(folder.read("right"), "right");
}

// The work of a signal handler before it ends the process.
TEST(AtomicFile, UnfinishedFilesCanBeRemovedAtOnce) {
  const TemporaryFolder folder;
  folder.write("a.txt", "old");
  AtomicFile done(folder.path("b.txt"));
  done.commit();
  AtomicFile open(folder.path("a.txt")), written(folder.path("c.txt"));
  written.finish();
  EXPECT_EQ(folder.names().size(), 4u);
  remove_unfinished_files();
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.txt", "b.txt"}));
}

TEST(AtomicFile, ASignalEndsTheProcessAndLeavesNothing) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "skipped: the thread sanitizer holds signals back";
#endif
  const TemporaryFolder folder;
  for (const int number : {SIGHUP, SIGINT, SIGTERM}) {
    const pid_t child = fork();
    if (child == 0) {
      const int out = open(folder.path("words").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      dup2(out, STDERR_FILENO);
      signal(number, SIG_DFL);
      end_on_interrupts([](int) { return "stopped\n"; });
      const AtomicFile file(folder.path("a.txt"));
      std::fputs("half", file.stream());
      raise(number);
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 128 + number);
    EXPECT_EQ(folder.read("words"), "stopped\n");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"words"});
  }
}

TEST(AtomicFile, WhatAKilledProcessLeftGoesWithTheNextOne) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    AtomicFile file(folder.path("a.txt"));
    kill(getpid(), SIGKILL);
  }
  waitpid(child, nullptr, 0);
  ASSERT_EQ(folder.names().size(), 1u);
  const std::string left = folder.names()[0];
  const std::string others = ".b" + left.substr(2);  // of another file
  // The file of a living process.
  const std::string alive = left.substr(0, left.rfind("." + std::to_string(child) + ".")) + ".1.0";
  for (const std::string& name : {others, alive}) folder.write(name, "");
  const int held = open(folder.path(left).c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(flock(held, LOCK_EX), 0);  // as another container's process would have it
  { const AtomicFile file(folder.path("a.txt")); }
  EXPECT_EQ(folder.names().size(), 3u);
  close(held);
  AtomicFile(folder.path("a.txt")).commit();
  EXPECT_EQ(folder.names(), (std::vector<std::string>{alive, others, "a.txt"}));
}

TEST(AtomicFile, MakesFolders) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(check_writable(folder.path("a/b/c.txt")));
  EXPECT_TRUE(folder.names().empty());
  AtomicFile file(folder.path("a/b/c.txt"));
  file.commit();
  EXPECT_EQ(folder.read("a/b/c.txt"), "");
}

TEST(AtomicFile, NamesAreBytesOfAnyLength) {
  const TemporaryFolder folder;
  for (const std::string& name : {std::string("\xff %V ?\xc3\xa9.png"), std::string(255, 'x')}) {
    AtomicFile file(folder.path(name));
    std::fputs("x", file.stream());
    file.commit();
    EXPECT_EQ(folder.read(name), "x");
  }
}

std::string refusal(const std::string& path) {
  std::string checked, made;
  try {
    check_writable(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kOutput);
    checked = error.what();
  }
  try {
    AtomicFile file(path);
  } catch (const Error& error) {
    made = error.what();
  }
  EXPECT_EQ(checked, made);
  EXPECT_EQ(checked.find('\n'), std::string::npos);
  return checked;
}

TEST(AtomicFile, RefusesWhatIsNoFile) {
  const TemporaryFolder folder;
  folder.write("file", "x");
  EXPECT_NE(refusal(folder.path("")), "");
  EXPECT_NE(refusal(folder.path(".")), "");
  EXPECT_NE(refusal(""), "");
  EXPECT_NE(refusal("/dev/null"), "");
  EXPECT_NE(refusal("/proc/a.txt"), "") << "where root may write, and cannot";
  EXPECT_NE(refusal(folder.path(std::string(256, 'x'))), "");
  EXPECT_NE(refusal(folder.path("file/a.txt")), "");
  EXPECT_NE(refusal(folder.path("file/new/a.txt")), "");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"file"});
  EXPECT_EQ(refusal(folder.path("file")), "");
}

TEST(AtomicFile, RefusesUnwritableFolder) {
  if (geteuid() == 0) GTEST_SKIP() << "skipped: root may write everywhere";
  const TemporaryFolder folder;
  chmod(folder.path("").c_str(), 0555);
  EXPECT_NE(refusal(folder.path("a.txt")), "");
  EXPECT_NE(refusal(folder.path("new/a.txt")), "");
  chmod(folder.path("").c_str(), 0755);
}

TEST(AtomicFile, NoticesAFullDisk) {
  const TinyDisk disk;
  if (!disk.mounted()) GTEST_SKIP() << "skipped: a small tmpfs can only be mounted by root with CAP_SYS_ADMIN";
  {
    AtomicFile file(disk.folder().path("a.txt"));
    const std::string megabyte(1 << 20, 'x');
    std::fwrite(megabyte.data(), 1, megabyte.size(), file.stream());
    EXPECT_THROW(file.finish(), Error);
    EXPECT_THROW(file.commit(), Error) << "a second try must not publish a part";
  }
  {
    // So little that it waits in the stream's buffer until the end.
    disk.fill();
    AtomicFile file(disk.folder().path("b.txt"));
    std::fputs("x", file.stream());
    EXPECT_THROW(file.commit(), Error);
  }
  EXPECT_EQ(disk.folder().names(), std::vector<std::string>{"ballast"});
}

}  // namespace
}  // namespace ods
