// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Source: APPNOTE.TXT of PKWARE, version 6.3.10, sections 4.3.7 (local header), 4.3.12 (central directory), 4.3.16 (end).
#include "ods/files/stored_zip.h"

#include <fmt/format.h>

#include "ods/base/checksum.h"
#include "ods/base/error.h"

namespace ods {

static void append_little(std::string& bytes, uint64_t value, int count) {
  for (int i = 0; i < count; i++) bytes += static_cast<char>(value >> (8 * i) & 0xff);
}

// The fields that local header and central directory share: from "version needed" to the length of the name.
static std::string common_fields(const StoredFile& file) {
  constexpr uint64_t kVersion = 10, kFirstDay = 1 << 5 | 1;  // 1980-01-01: the month in bits 5 to 8, the day below
  std::string fields;
  append_little(fields, kVersion, 2);
  append_little(fields, 0, 2);  // flags
  append_little(fields, 0, 2);  // method: stored
  append_little(fields, 0, 2);  // time
  append_little(fields, kFirstDay, 2);
  append_little(fields, crc32(file.bytes), 4);
  append_little(fields, file.bytes.size(), 4);  // in the archive
  append_little(fields, file.bytes.size(), 4);
  append_little(fields, file.name.size(), 2);
  return fields;
}

// The extra field after a local header that ends at this position, so that the file's bytes begin at a multiple.
static std::string padding(uint64_t position, size_t alignment) {
  constexpr size_t kFieldHeader = 4;
  size_t size = (alignment - position % alignment) % alignment;
  if (size == 0) return "";
  while (size < kFieldHeader) size += alignment;
  std::string field;
  append_little(field, 0x1986, 2);
  append_little(field, size - kFieldHeader, 2);
  return field + std::string(size - kFieldHeader, '\0');
}

void write_stored_zip(ByteSink& sink, std::span<const StoredFile> files, size_t alignment) {
  constexpr size_t kLocalHeader = 30, kLargest = 0xffffffff, kMostFiles = 0xffff;
  const auto write = [&](const std::string& bytes) { sink.write(bytes.data(), bytes.size()); };
  uint64_t total = 0;
  for (const StoredFile& file : files) total += 2 * (kLocalHeader + file.name.size() + alignment) + file.bytes.size();
  if (total > kLargest || files.size() > kMostFiles) {
    throw Error(ErrorKind::kOutput, fmt::format("cannot write '{}': a .zip archive holds at most 4 GB and {} files",
                                                sink.path(), kMostFiles));
  }
  std::string directory;
  for (const StoredFile& file : files) {
    const uint64_t at = sink.position();
    const std::string fields = common_fields(file);
    const std::string extra = padding(at + kLocalHeader + file.name.size(), alignment);
    std::string header = "PK\3\4" + fields;
    append_little(header, extra.size(), 2);
    write(header + file.name + extra);
    write(file.bytes);
    directory += "PK\1\2";
    append_little(directory, 20, 2);  // made by version 2.0, MS-DOS: no permissions
    directory += fields;
    append_little(directory, 0, 2 + 2 + 2 + 2);  // extra field, comment, disk, internal attributes
    append_little(directory, 0, 4);              // external attributes
    append_little(directory, at, 4);
    directory += file.name;
  }
  std::string end = "PK\5\6";
  append_little(end, 0, 4);  // disks
  append_little(end, files.size(), 2);
  append_little(end, files.size(), 2);
  append_little(end, directory.size(), 4);
  append_little(end, sink.position(), 4);
  append_little(end, 0, 2);  // comment
  write(directory + end);
}

}  // namespace ods
