// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Rejects EXR files that exploit OpenEXR's trust in the header. Source: OpenEXR, "OpenEXR File Layout".
#pragma once
#include <cstddef>
#include <string>

#include "ods/files/read_file.h"

namespace ods {

// The reason why an EXR of this size is rejected before OpenEXR reads it, for messages. Empty if it is not. It may be
// too short for its headers' claims (attributes, and an offset table entry for every chunk), an attribute may have a
// size that differs from its value's, or its pictures may exceed image_limits.h. OpenEXR allocates memory for these
// before it checks the file, so a few bytes could request gigabytes.
std::string exr_header_fault(size_t file_size, const ByteReader& read);

}  // namespace ods
