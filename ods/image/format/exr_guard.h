// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Rejects EXR files that OpenEXR would trust too much. Source: OpenEXR, "OpenEXR File Layout".
#pragma once
#include <cstddef>

#include "ods/files/read_file.h"

namespace ods {

// Whether an EXR of this size is long enough for what its headers announce: attributes, and an offset table entry for
// every chunk. False also if an attribute states another size than its value has. OpenEXR allocates for these before it
// checks the file, so a few bytes can ask for gigabytes.
bool has_room_for_header(size_t file_size, const ByteReader& read);

}  // namespace ods
