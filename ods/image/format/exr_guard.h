// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What OpenEXR takes a file's word for. OpenEXR, "OpenEXR File Layout".
#pragma once
#include <cstddef>

#include "ods/files/read_file.h"

namespace ods {

// Whether an EXR of so many bytes has room for what its headers announce: attributes, and an offset for every chunk of
// pixels. OpenEXR makes the room in memory first and looks at the file behind it; a few bytes can ask for gigabytes.
bool has_room_for_header(size_t file_size, const ByteReader& read);

}  // namespace ods
