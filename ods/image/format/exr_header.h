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
  uint64_t end = 0;  // just past the terminating zero, where the chunk offset table starts
};

inline constexpr size_t kExrOffsetSize = 8;  // bytes of each of those offsets

// Throws Error(kInput): not an EXR, truncated, damaged, or multi-part.
ExrHeader read_exr_header(const FileInput& file);

// Size, channels, and the attributes that are text or numbers, as read_info() returns them.
FileInfo exr_info(const ExrHeader& header);

// Converts to the EXR types: int, float, string, stringvector, v2f, v3f.
ExrAttribute exr_attribute(const Attribute& attribute);

// The attribute that holds it, as text: what is read from the header is what was written.
inline constexpr const char* kExrChecksum = "ods:headerChecksum";

// A checksum of all attributes but that one, in their order, as text.
std::string exr_checksum(const ExrHeader& header);

// Writes the file with these attributes. The chunks stay byte-identical; their offsets are updated. Throws
// Error(kInput): damaged offsets, as in a picture that was never finished; Error(kOutput).
void write_exr_header(const FileInput& file, AtomicFile& to, const ExrHeader& header);

}  // namespace ods
