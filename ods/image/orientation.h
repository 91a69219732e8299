// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The rotation of a picture for display. Source: JEITA CP-3451, "Exif 2.3", tag Orientation.
#pragma once
#include "ods/files/file_input.h"

namespace ods {

// 1: as stored; 2 mirrored, 3 upside down, 4 both, 5 to 8 the same with rows and columns exchanged. From the Exif of
// JPEG, PNG and WebP and from the directory of TIFF; always 1 for other formats and damaged files.
int orientation_of(const FileInput& file);

}  // namespace ods
