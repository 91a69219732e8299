// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/byte_sink.h"

#include <gtest/gtest.h>

#include "ods/files/atomic_file.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

void write_about(ByteSink& sink) {
  sink.write("0123456789", 10);
  sink.seek(2);
  sink.write("ab", 2);
  EXPECT_EQ(sink.position(), 4u);
  sink.seek(12);
  sink.write("", 0);
  sink.write("end", 3);
  EXPECT_EQ(sink.position(), 15u);
}

TEST(ByteSink, MemoryAndFilesGetTheSameBytes) {
  const TemporaryFolder folder;
  MemorySink memory("a name");
  write_about(memory);
  EXPECT_EQ(memory.path(), "a name");
  EXPECT_EQ(memory.bytes(), std::string("01ab456789\0\0end", 15));
  AtomicFile file(folder.path("file"));
  write_about(file);
  file.commit();
  EXPECT_EQ(folder.read("file"), memory.take());
}

}  // namespace
}  // namespace ods
