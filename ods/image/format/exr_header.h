// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the header of an EXR attribute by attribute, and replaces it without touching the pixels. Source: OpenEXR,
// "OpenEXR File Layout".
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ods/files/atomic_file.h"
#include "ods/files/file_input.h"
#include "ods/image/format/attribute.h"
#include "ods/image/format/file_info.h"
#include "ods/image/format/image_limits.h"

namespace ods {

struct ExrAttribute {
  std::string name, type;
  std::string value;  // bytes as in the file, little endian
};

struct ExrHeader {
  std::vector<ExrAttribute> attributes;
  uint64_t end = 0;  // just after the terminating zero, where the chunk offset table starts
};

inline constexpr size_t kExrOffsetSize = 8;  // bytes of each of those offsets

// Throws Error(kInput) if the file is not an EXR, truncated, damaged, or multi-part.
ExrHeader read_exr_header(const FileInput& file);

// The size, the channels, and the attributes that are text or numbers, as in read_info().
FileInfo exr_info(const ExrHeader& header);

// Converts to the EXR types: int, float, string, stringvector, v2f, v3f.
ExrAttribute exr_attribute(const Attribute& attribute);

// The attribute with the checksum, as text. It verifies that the header is read as it was written.
inline constexpr const char* kExrChecksum = "ods:headerChecksum";

// A checksum of all other attributes, in their order, as text.
std::string exr_checksum(const ExrHeader& header);

// Writes the file with these attributes. The chunks stay byte-identical; their offsets are updated. Throws
// Error(kInput) for damaged offsets, as in a picture that was never finished; Error(kOutput).
void write_exr_header(const FileInput& file, AtomicFile& to, const ExrHeader& header);

}  // namespace ods
