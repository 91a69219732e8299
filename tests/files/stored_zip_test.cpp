// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/stored_zip.h"

#include <gtest/gtest.h>

#include <vector>

#include "ods/files/zip_archive.h"
#include "tests/support/programs.h"
#include "tests/support/temporary_folder.h"

namespace ods {

namespace {

std::string archive_of(const std::vector<StoredFile>& files, size_t alignment) {
  MemorySink sink("test.zip");
  write_stored_zip(sink, files, alignment);
  return sink.take();
}

// Files whose names and contents have every length modulo 64, each with contents that occur once.
std::vector<StoredFile> many_files() {
  std::vector<StoredFile> files;
  for (size_t i = 0; i < 70; i++) {
    files.push_back({"f/" + std::string(1 + i, 'n'), "<" + std::to_string(i) + ">" + std::string(7 * i, 'x')});
  }
  files.push_back({"empty", ""});
  return files;
}

}  // namespace

TEST(StoredZip, HoldsFilesAsTheyAre) {
  const std::vector<StoredFile> files = many_files();
  for (const size_t alignment : {size_t{1}, size_t{64}}) {
    const std::string bytes = archive_of(files, alignment);
    ZipArchive archive({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}, "test.zip");
    EXPECT_EQ(archive.names().size(), files.size());
    for (const StoredFile& file : files) {
      const std::vector<unsigned char> found = archive.read(file.name);
      EXPECT_EQ(std::string(found.begin(), found.end()), file.bytes) << file.name;
    }
  }
}

TEST(StoredZip, AlignsEachFile) {
  const std::vector<StoredFile> files = many_files();
  const std::string bytes = archive_of(files, 64);
  for (const StoredFile& file : files) {
    EXPECT_TRUE(file.bytes.empty() || bytes.find(file.bytes) % 64 == 0) << file.name;
  }
  EXPECT_LT(bytes.size(), archive_of(files, 1).size() + files.size() * (64 + 4));
}

TEST(StoredZip, IsReadByUnzip) {
  const std::string reason = missing("unzip", "unzip -v");
  if (!reason.empty()) GTEST_SKIP() << reason;
  const TemporaryFolder folder;
  folder.write("test.zip", archive_of(many_files(), 64));
  const Ran ran = run_line("unzip -tq '" + folder.path("test.zip") + "'");
  EXPECT_EQ(ran.code, 0) << ran.out;
}

TEST(StoredZip, RefusesMoreThanItCanHold) {
  const std::vector<StoredFile> files(65536);
  EXPECT_THROW(archive_of(files, 1), Error);
}

}  // namespace ods
