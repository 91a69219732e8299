// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads and replaces the XMP packet of a JPEG (APP1), PNG (iTXt) or TIFF (tag 700) without touching the coded pixels.
// Source: Adobe, "XMP Specification Part 3: Storage in Files".
#pragma once
#include <string>

#include "ods/files/file_input.h"

namespace ods {

// Returns the packet of a picture's first page, with the usual prefixes of Google's namespaces; an empty string for a
// picture without a packet that can be decoded. Reads compressed packets of PNG, and those that ImageMagick writes as
// text, too. In formats other than JPEG, PNG and TIFF, takes the first data in the first megabyte that look like a
// packet. Throws Error(kInput) for a missing file.
std::string read_xmp(const std::string& path);
std::string read_xmp(const FileInput& file);

// Writes the file with this packet in place of its own; with an empty one, without a packet. Everything else stays
// byte-identical; in a TIFF it also keeps its position, because packet and directory are appended. Throws Error(kInput)
// for another format, a damaged file, a compressed packet, or a packet that does not fit; Error(kOutput).
void write_xmp(const FileInput& file, AtomicFile& to, const std::string& packet);

}  // namespace ods
