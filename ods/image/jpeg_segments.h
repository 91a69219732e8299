// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What libjpeg does not tell of a JPEG file. ITU-T T.81, annex B.
#pragma once
#include <cstddef>

#include "ods/base/read_file.h"

namespace ods {

// Whether a JPEG of so many bytes goes on from its first marker to its last one, the end of the image. Thumbnails in
// its headers have ends of their own, and do not count.
bool is_whole_jpeg(size_t file_size, const ByteReader& read);

}  // namespace ods
