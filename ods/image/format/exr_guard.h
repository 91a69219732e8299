// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Rejects EXR files that OpenEXR would trust too much. Source: OpenEXR, "OpenEXR File Layout".
#pragma once
#include <cstddef>
#include <string>

#include "ods/files/read_file.h"

namespace ods {

// Why an EXR of this size is refused before OpenEXR sees it, for messages; empty: it is not. It may be too short for
// what its headers announce (attributes, and an offset table entry for every chunk), an attribute may state another
// size than its value has, or its pictures may exceed image_limits.h. OpenEXR allocates for these before it checks the
// file, so a few bytes can ask for gigabytes.
std::string exr_header_fault(size_t file_size, const ByteReader& read);

}  // namespace ods
