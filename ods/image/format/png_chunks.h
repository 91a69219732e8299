// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What OpenImageIO does not do for PNG. ISO/IEC 15948 (PNG); Adobe, "XMP Specification Part 3" for the XMP chunk.
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

// The bytes of a chunk: length, type, data, CRC.
std::string png_chunk(std::string_view type, std::string_view data);

// How the data of the iTXt chunk begins that holds a packet of XMP: its keyword and a zero. Behind them stand: not
// compressed (else 1), method 0, no language, no translated keyword.
inline constexpr std::string_view kPngXmpKeyword{"XML:com.adobe.xmp\0", 18};
std::string xmp_chunk(const std::string& packet);

// The bytes of the iTXt chunk that holds those of them that are; empty where none is.
std::string gpano_chunk(const std::vector<Attribute>& attributes);

// Where a chunk may be put in a PNG: right behind its header chunk.
inline constexpr size_t kPngAfterHeader = 33;

// A chunk of a file: four bytes of length, four of type, the data, four of CRC. Throws Error(kInput) where the file
// does not hold it whole.
struct PngChunk {
  std::string type;
  uint64_t length = 0;  // of the data
};
PngChunk read_png_chunk(const FileInput& file, uint64_t at);

// In pixels, as its header says. Throws Error(kInput): it has none.
Extent png_size(const FileInput& file);

struct FileRange {
  size_t offset = 0;
  size_t size = 0;
};

// Parts of a file, read as if they lay one behind the other.
class FileParts {
 public:
  FileParts(ByteReader file, std::vector<FileRange> parts);
  size_t size() const { return size_; }
  // How many bytes there were.
  size_t read(size_t offset, void* to, size_t size) const;

 private:
  ByteReader file_;
  std::vector<FileRange> parts_;
  std::vector<size_t> starts_;  // of every part, in what is read
  size_t size_ = 0;
};

// Where in a file of so many bytes the parts of a PNG lie that make its pixels, and the word ods:rig; nothing when one
// is cut short, damaged or missing. libpng comments on such files, and on common flaws of the other chunks, on stderr.
// (It still does on a file whose chunks are whole and make no picture: OpenImageIO's handler of errors returns into
// libpng, which then prints. Only unpacking the pixels twice would tell before.)
std::optional<std::vector<FileRange>> essential_png(size_t file_size, const ByteReader& read);

}  // namespace ods
