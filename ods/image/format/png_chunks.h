// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// PNG chunks, without pixels. Sources: ISO/IEC 15948 (PNG); Adobe, "XMP Specification Part 3" for XMP.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/extent.h"
#include "ods/files/file_input.h"
#include "ods/files/read_file.h"
#include "ods/image/format/xmp.h"

namespace ods {

// A whole chunk: length, type, data, CRC.
std::string png_chunk(std::string_view type, std::string_view data);

// The prefix of an iTXt chunk with an XMP packet: the keyword and a zero. It is followed by compression flag (0: none),
// method 0, empty language, empty translated keyword.
inline constexpr std::string_view kPngXmpKeyword{"XML:com.adobe.xmp\0", 18};
std::string xmp_chunk(const std::string& packet);

// The position of new chunks: directly after the header chunk.
inline constexpr size_t kPngAfterHeader = 33;

// A chunk of a file: four bytes of length, four of type, the data, four of CRC. Throws Error(kInput) if the file does
// not contain all of it.
struct PngChunk {
  std::string type;
  uint64_t length = 0;  // length of the data alone
};
PngChunk read_png_chunk(const FileInput& file, uint64_t at);

// The size in pixels from the header. Throws Error(kInput) if there is none.
Extent png_size(const FileInput& file);

struct FileRange {
  size_t offset = 0;
  size_t size = 0;
};

// Reads ranges of a file as if they were concatenated.
class FileParts {
 public:
  FileParts(ByteReader file, std::vector<FileRange> parts);
  size_t size() const { return size_; }
  // Returns the number of bytes read.
  size_t read(size_t offset, void* to, size_t size) const;

 private:
  ByteReader file_;
  std::vector<FileRange> parts_;
  std::vector<size_t> starts_;  // start of each part, in the concatenation
  size_t size_ = 0;
};

// The file ranges of a PNG that are needed for its pixels and for ods:rig. Returns nullopt if one of them is truncated,
// damaged or missing. The decoder reads only these, so that other parts of the file cannot cause errors.
std::optional<std::vector<FileRange>> essential_png(size_t file_size, const ByteReader& read);

}  // namespace ods
