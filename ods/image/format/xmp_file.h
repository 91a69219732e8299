// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a packet of XMP stands in a JPEG (APP1), a PNG (iTXt) and a TIFF (tag 700), and how it gets there without the
// coded pixels being touched. Source: Adobe, "XMP Specification Part 3: Storage in Files".
#pragma once
#include <string>

#include "ods/files/file_input.h"

namespace ods {

// The packet of a picture's first page; empty where there is none, or where it cannot be found or unpacked. Other
// formats: what looks like one in the first megabyte. Throws Error(kInput): there is no such file.
std::string read_xmp(const std::string& path);
std::string read_xmp(const FileInput& file);

// Writes the file with this packet in place of its own; an empty one: without any. Everything else stays byte for byte
// what it was: in a TIFF also where it was, as packet and directory go to its end. Throws Error(kInput): it is no such
// file, or damaged, or its packet is compressed, or does not fit into it; Error(kOutput).
void write_xmp(const FileInput& file, AtomicFile& to, const std::string& packet);

}  // namespace ods
