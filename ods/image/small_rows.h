// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads picture files for previews.
#pragma once
#include "ods/image/image_file.h"

namespace ods {

// Like open_rows(), but decodes a JPEG at an eighth, a quarter or half of its size, if that is at least `min_width`
// pixels wide, which avoids nearly all of libjpeg's work. Throws like open_rows().
std::unique_ptr<RowReader> open_small_rows(const std::string& path, int min_width);

}  // namespace ods
