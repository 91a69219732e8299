// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The first directory of a TIFF: its entries as they stand there, and how it is replaced. Sources: Adobe, "TIFF
// Revision 6.0", section 2; "The BigTIFF File Format Proposal".
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ods/files/file_input.h"

namespace ods {

struct TiffEntry {
  uint16_t tag = 0;
  uint16_t type = 0;
  uint64_t count = 0;
  std::string place;  // 4 bytes, of BigTIFF 8: the value where it fits, else where it lies
};

struct TiffDirectory {
  bool is_big = false;     // BigTIFF: offsets of 8 bytes
  bool is_little = false;  // the low byte first
  std::vector<TiffEntry> entries;
  uint64_t next = 0;  // where the next directory lies; 0: nowhere
};

inline constexpr uint16_t kTiffWidth = 256, kTiffHeight = 257, kTiffXmp = 700;

// Throws Error(kInput): it has no directory.
TiffDirectory read_tiff_directory(const FileInput& file);

// The bytes of an entry; nothing where there is no such entry, or its bytes lie beyond the file or are more than
// `most`.
std::optional<std::string> tiff_value(const FileInput& file, const TiffDirectory& directory, uint16_t tag,
                                      uint64_t most);
// Its first number.
std::optional<uint64_t> tiff_number(const FileInput& file, const TiffDirectory& directory, uint16_t tag);

// Writes the file with these bytes in place of what the entry had, or without the entry: value and directory stand
// behind all that was there, which stays where it is. Throws Error(kInput): a TIFF that is not Big would be too long.
void write_tiff_value(const FileInput& file, AtomicFile& to, TiffDirectory directory, uint16_t tag,
                      const std::string& bytes);

}  // namespace ods
