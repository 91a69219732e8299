// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The header of an EXR as it stands there, attribute by attribute, and how it is replaced without the pixels being
// touched. Source: OpenEXR, "OpenEXR File Layout".
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
  std::string value;  // the bytes of the file, the low one first
};

struct ExrHeader {
  std::vector<ExrAttribute> attributes;
  uint64_t end = 0;  // behind the zero that ends it: where the offsets of the chunks stand
};

// Throws Error(kInput): no EXR, cut short, damaged; one of several parts.
ExrHeader read_exr_header(const FileInput& file);

// Size, channels, and the attributes that are words or numbers, as read_info() has them.
FileInfo exr_info(const ExrHeader& header);

// As an EXR has it: int, float, string, stringvector, v2f, v3f.
ExrAttribute exr_attribute(const Attribute& attribute);

// Writes the file with these attributes; the chunks stay byte for byte what they were, and their offsets follow them.
// Throws Error(kInput): offsets that are damaged, as in a picture that was never finished; Error(kOutput).
void write_exr_header(const FileInput& file, AtomicFile& to, const ExrHeader& header);

}  // namespace ods
