// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What OpenImageIO does not do for PNG. ISO/IEC 15948 (PNG); Adobe, "XMP Specification Part 3" for the XMP chunk.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ods/base/read_file.h"
#include "ods/image/attribute.h"

namespace ods {

// Whether an attribute is one of Google's panorama namespace: GPano:FullPanoWidthPixels.
bool is_gpano(const Attribute& attribute);

// The bytes of the iTXt chunk that holds those of them that are; empty where none is.
std::string gpano_chunk(const std::vector<Attribute>& attributes);

// Where a chunk may be put in a PNG: right behind its header chunk.
inline constexpr size_t kPngAfterHeader = 33;

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

// Where in a file of so many bytes the parts of a PNG lie that make its pixels; nothing when one is cut short, damaged
// or missing. libpng comments on such files, and on common flaws of the other chunks, on stderr. (It still does on a
// file whose chunks are whole and make no picture: OpenImageIO's handler of errors returns into libpng, which then
// prints. Only unpacking the pixels twice would tell before.)
std::optional<std::vector<FileRange>> essential_png(size_t file_size, const ByteReader& read);

}  // namespace ods
