// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/large_blocks.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <vector>

namespace ods {
namespace {

constexpr size_t kMegabyte = 1 << 20;

size_t resident_megabytes() {
  size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages >> pages;
  return pages * static_cast<size_t>(sysconf(_SC_PAGESIZE)) / kMegabyte;
}

// volatile: a compiler may drop a block that is never read.
void* touched(size_t size) {
  void* volatile block = std::malloc(size);
  std::memset(block, 1, size);
  return block;
}

// Megabytes that stay resident after a large block is freed while a small one that came later is in use.
size_t left_behind() {
  std::free(touched(30 * kMegabyte));  // after this, glibc keeps blocks of up to 30 MB in its heap
  const size_t before = resident_megabytes();
  void* const large = touched(20 * kMegabyte);
  void* const small = touched(1000);
  std::free(large);
  const size_t after = resident_megabytes();
  std::free(small);
  return after - before;
}

// One test, because the change lasts as long as the process.
TEST(LargeBlocks, GoBackToTheSystem) {
#if !defined(__GLIBC__) || defined(ODS_SANITIZED)
  GTEST_SKIP() << "skipped: the allocator is not glibc's";
#endif
  EXPECT_GE(left_behind(), 19u) << "this test's premise";
  return_large_blocks();
  EXPECT_LE(left_behind(), 1u);
}

// Blocks of a kilobyte that a few which stay in use keep in the heap.
TEST(FreeMemory, GoesBackToTheSystem) {
#if !defined(__GLIBC__) || defined(ODS_SANITIZED)
  GTEST_SKIP() << "skipped: the allocator is not glibc's";
#endif
  std::vector<void*> blocks, kept;
  for (size_t i = 0; i < 64 * 1024; i++) blocks.push_back(touched(1000));
  const size_t used = resident_megabytes();
  for (size_t i = 0; i < blocks.size(); i++) i % 1000 == 999 ? kept.push_back(blocks[i]) : std::free(blocks[i]);
  EXPECT_GE(resident_megabytes() + 8, used) << "this test's premise";
  return_free_memory();
  EXPECT_LE(resident_megabytes() + 48, used);
  for (void* block : kept) std::free(block);
}

}  // namespace
}  // namespace ods
