// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads and replaces the first directory of a TIFF. Sources: Adobe, "TIFF Revision 6.0", section 2; "The BigTIFF File
// Format Proposal".
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
  std::string place;  // 4 bytes, 8 in BigTIFF: the value if it fits, else its file offset
};

struct TiffDirectory {
  bool is_big = false;     // BigTIFF: 8-byte offsets
  bool is_little = false;  // little endian
  std::vector<TiffEntry> entries;
  uint64_t next = 0;  // offset of the next directory; 0 if there is none
};

inline constexpr uint16_t kTiffWidth = 256, kTiffHeight = 257, kTiffOrientation = 274, kTiffXmp = 700;

// Throws Error(kInput) if there is no valid directory.
TiffDirectory read_tiff_directory(const FileInput& file);

// The bytes of an entry. Returns nullopt if the entry is missing, extends beyond the end of the file or has more than
// `maximum` bytes.
std::optional<std::string> tiff_value(const FileInput& file, const TiffDirectory& directory, uint16_t tag,
                                      uint64_t maximum);
// The first number of an entry.
std::optional<uint64_t> tiff_number(const FileInput& file, const TiffDirectory& directory, uint16_t tag);

// Writes the file with this value for the entry, or without the entry if there is none. The new value and directory are
// appended, and all other bytes keep their places. Throws Error(kInput) if the result would be too long for a TIFF that
// is not BigTIFF.
void write_tiff_value(const FileInput& file, AtomicFile& to, TiffDirectory directory, uint16_t tag,
                      const std::string& bytes);

}  // namespace ods
