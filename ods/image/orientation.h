// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How a picture is to be turned before it is shown. Source: JEITA CP-3451, "Exif 2.3", tag Orientation.
#pragma once
#include "ods/files/file_input.h"

namespace ods {

// 1: as stored; 2 mirrored, 3 upside down, 4 both, 5 to 8 likewise with rows for columns. Of a JPEG or TIFF, whose
// camera was held so; all other formats, and damaged files: 1.
int orientation_of(const FileInput& file);

}  // namespace ods
