// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>

#include "ods/base/error.h"
#include "ods/files/read_file.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

// A machine of 1000 kB, in the files that a kernel would show.
class Machine : public ::testing::Test {
 protected:
  Machine() { write("proc/meminfo", "MemTotal:  2000 kB\nMemFree: 10 kB\nMemAvailable:    1000 kB\n"); }
  void write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories(std::filesystem::path(folder.path(name)).parent_path());
    folder.write(name, text);
  }
  size_t available() const { return available_memory(folder.path("")); }
  TemporaryFolder folder;
};

TEST_F(Machine, WithoutGroups) {
  EXPECT_EQ(available(), 1000u * 1024);
}

TEST_F(Machine, Version2CountsEveryGroupAboveAndNotItsCache) {
  write("proc/self/cgroup", "0::/a/b\n");
  write("sys/fs/cgroup/a/b/memory.max", "max\n");
  write("sys/fs/cgroup/a/b/memory.current", "5000\n");
  EXPECT_EQ(available(), 1000u * 1024);
  write("sys/fs/cgroup/a/memory.max", "90000\n");
  write("sys/fs/cgroup/a/memory.current", "50000\n");
  EXPECT_EQ(available(), 40000u);
  write("sys/fs/cgroup/a/memory.stat", "anon 1\ninactive_file 7000\nactive_file 3000\nslab 9\n");
  EXPECT_EQ(available(), 50000u);
  write("sys/fs/cgroup/memory.max", "60000\n");  // a container's own, seen from inside
  write("sys/fs/cgroup/memory.current", "60001\n");
  EXPECT_EQ(available(), 0u);
}

TEST_F(Machine, Version1) {
  write("proc/self/cgroup", "9:name=systemd:/\n4:memory:/jobs/1\n2:cpu,cpuacct:/\n0::/\n");
  write("sys/fs/cgroup/memory/jobs/1/memory.limit_in_bytes", "9223372036854771712\n");
  write("sys/fs/cgroup/memory/jobs/1/memory.usage_in_bytes", "400\n");
  EXPECT_EQ(available(), 1000u * 1024);
  write("sys/fs/cgroup/memory/jobs/memory.limit_in_bytes", "1000\n");
  write("sys/fs/cgroup/memory/jobs/memory.usage_in_bytes", "400\n");
  write("sys/fs/cgroup/memory/jobs/memory.stat", "cache 300\ntotal_inactive_file 100\n");
  EXPECT_EQ(available(), 700u);
}

TEST_F(Machine, ThatSaysNothing) {
  write("proc/meminfo", "");
  EXPECT_EQ(available(), SIZE_MAX);
}

TEST(Memory, ThisMachine) {
  EXPECT_GT(available_memory(), size_t{1} << 20);
  EXPECT_LT(available_memory(), size_t{1} << 50);
}

TEST(Memory, ALimitOfAddressSpaceCounts) {
  const pid_t child = fork();
  if (child == 0) {
    const rlimit limit{rlim_t{1} << 50, rlim_t{1} << 50};  // far away, or sanitizers could not live
    setrlimit(RLIMIT_AS, &limit);
    _exit(available_memory("/nowhere") < (size_t{1} << 50) ? 0 : 1);
  }
  int status = 1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST(Memory, ARefusalIsOneLineWithTheNumbers) {
  EXPECT_NO_THROW(check_memory(1, "a byte", "take none"));
  try {
    check_memory(size_t{1} << 60, "a picture", "make it smaller");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kMemory);
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with("a picture needs 1152921504.6 GB of memory, and ")) << text;
    EXPECT_TRUE(text.ends_with(" are free; make it smaller")) << text;
  }
}

// --- files ---------------------------------------------------------------------------------------------------------

TEST(ReadFile, WholeAndStart) {
  const TemporaryFolder folder;
  folder.write("a", "abc");
  EXPECT_EQ(file_size(folder.path("a")), 3u);
  EXPECT_EQ(read_file(folder.path("a"), 3), (std::vector<unsigned char>{'a', 'b', 'c'}));
  EXPECT_THROW(read_file(folder.path("a"), 2), Error);
  EXPECT_EQ(read_start(folder.path("a"), 2), (std::vector<unsigned char>{'a', 'b'}));
  EXPECT_EQ(read_start(folder.path("a"), 99).size(), 3u);
  EXPECT_THROW(read_start(folder.path("b"), 1), Error);
  EXPECT_THROW(read_file(folder.path(""), 1), Error);
}

// A file of petabytes takes no room on the disk.
TEST(ReadFile, MoreThanThereIsMemoryForIsRefused) {
  const TemporaryFolder folder;
  folder.write("a", "abc");
  std::error_code error;
  std::filesystem::resize_file(folder.path("a"), uintmax_t{1} << 43, error);
  if (error) GTEST_SKIP() << "skipped: no sparse files of 8 TB here: " << error.message();
  try {
    read_start(folder.path("a"), SIZE_MAX);
    ADD_FAILURE();
  } catch (const Error& refused) {
    EXPECT_EQ(refused.kind(), ErrorKind::kMemory) << refused.what();
  }
  EXPECT_EQ(read_start(folder.path("a"), 3).size(), 3u);
}

}  // namespace
}  // namespace ods
