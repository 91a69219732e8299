// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/scratch.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "ods/base/error.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

// The resident memory of this process, in bytes.
size_t resident() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    std::istringstream words(line);
    std::string word;
    size_t kilobytes = 0;
    if (words >> word >> kilobytes && word == "VmRSS:") return kilobytes * 1024;
  }
  return 0;
}

std::byte pattern(size_t i) {
  return static_cast<std::byte>(i * 7 + i / 4096);
}

TEST(Scratch, KeepsWhatIsWrittenWhereverItLies) {
  const TemporaryFolder folder;
  const size_t size = 100001;
  for (size_t maximum : {size_t{0}, size}) {
    const Scratch scratch(size, folder.path(""), maximum);
    EXPECT_EQ(scratch.on_disk(), maximum == 0);
    EXPECT_EQ(scratch.size(), size);
    EXPECT_EQ(scratch.data()[size - 1], std::byte{0});
    for (size_t i = 0; i < size; i++) scratch.data()[i] = pattern(i);
    scratch.release();
    for (size_t i = 0; i < size; i++) ASSERT_EQ(scratch.data()[i], pattern(i));
    EXPECT_TRUE(folder.names().empty()) << "no other process sees it";
  }
}

TEST(Scratch, WithoutAFolderAllIsMemory) {
  EXPECT_FALSE(Scratch(4096, "", 0).on_disk());
  EXPECT_NE(Scratch(0, "", 0).data(), nullptr);
}

TEST(Scratch, ReleasedBytesAreNoLongerInMemory) {
#ifdef ODS_SANITIZED
  GTEST_SKIP() << "skipped: a sanitizer's own memory grows beside it";
#endif
  const TemporaryFolder folder;
  const size_t size = size_t{64} << 20;
  const Scratch scratch(size, folder.path(""), 0);
  const size_t before = resident();
  for (size_t i = 0; i < size; i += 4096) scratch.data()[i] = pattern(i);
  EXPECT_GT(resident(), before + size / 2);
  scratch.release();
  EXPECT_LT(resident(), before + size / 4);
  EXPECT_EQ(scratch.data()[size - 4096], pattern(size - 4096));
}

TEST(Scratch, AFullDiskIsAnErrorBeforeTheFirstByte) {
  const TinyDisk disk;
  if (!disk.mounted()) GTEST_SKIP() << "skipped: a small tmpfs can only be mounted by root with CAP_SYS_ADMIN";
  try {
    const Scratch scratch(1 << 20, disk.folder().path(""), 0);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kOutput);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
  EXPECT_TRUE(disk.folder().names().empty());
}

TEST(Scratch, AFileOutlivesWhoWroteIt) {
  const TemporaryFolder folder;
  const std::string file = folder.path("journal");
  {
    const Scratch scratch(5000, file, "mark");
    scratch.data()[4999] = std::byte{7};
    EXPECT_THROW(Scratch(5000, file, "mark"), Error);  // it is in use
  }
  EXPECT_EQ(Scratch(5000, file, "mark").data()[4999], std::byte{7});
  EXPECT_EQ(Scratch(6000, file, "mark").data()[4999], std::byte{0});  // another size, another thing
  EXPECT_EQ(Scratch(6000, file, "mark").data()[3], std::byte{'k'});
  EXPECT_THROW(Scratch(10, folder.path("absent/journal"), "mark"), Error);
}

TEST(Scratch, AFileThatIsNotOursIsLeftAsItIs) {
  const TemporaryFolder folder;
  folder.write("diary", "what happened today");
  std::filesystem::create_symlink(folder.path("diary"), folder.path("link"));
  std::filesystem::create_hard_link(folder.path("diary"), folder.path("hard"));
  std::filesystem::create_symlink(folder.path("nothing"), folder.path("dangling"));
  std::filesystem::create_directory(folder.path("folder"));
  ASSERT_EQ(mkfifo(folder.path("pipe").c_str(), 0600), 0);
  for (const char* name : {"diary", "link", "hard", "dangling", "folder", "pipe"}) {
    for (const size_t size : {size_t{19}, size_t{5000}}) {
      try {
        const Scratch scratch(size, folder.path(name), "mark");
        ADD_FAILURE() << name;
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::kOutput);
        EXPECT_NE(std::string(error.what()).find(folder.path(name)), std::string::npos) << error.what();
      }
    }
  }
  EXPECT_EQ(folder.read("diary"), "what happened today");
  EXPECT_EQ(folder.names().size(), 6u);
  folder.write("empty", "");  // of a process that was killed at its start
  EXPECT_EQ(Scratch(5000, folder.path("empty"), "mark").data()[4999], std::byte{0});
}

TEST(Scratch, AFileThatFindsNoRoomIsRemoved) {
  const TinyDisk disk;
  if (!disk.mounted()) GTEST_SKIP() << "skipped: a small tmpfs can only be mounted by root with CAP_SYS_ADMIN";
  EXPECT_THROW(Scratch(1 << 20, disk.folder().path("journal"), "mark"), Error);
  EXPECT_TRUE(disk.folder().names().empty());
}

TEST(Scratch, SaysWhyNot) {
  const TemporaryFolder folder;
  EXPECT_THROW(Scratch(10, folder.path("absent"), 0), Error);
  EXPECT_THROW(Scratch(SIZE_MAX / 4, "", 0), Error);
}

}  // namespace
}  // namespace ods
