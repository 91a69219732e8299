// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The metadata that cameras write into a picture: date, place, author. Source: JEITA CP-3451, "Exif 2.3".
#pragma once
#include <string>
#include <string_view>

#include "ods/base/extent.h"
#include "ods/files/file_input.h"

namespace ods {

inline constexpr std::string_view kExifPrefix{"Exif\0\0", 6};  // of the segment of a JPEG

// Returns the Exif of a JPEG, PNG, WebP or HEIF without its prefix: a TIFF directory. Returns an empty string for a file
// without Exif or with more than 16 MB of it. Throws Error(kInput) for a damaged file.
std::string read_exif(const FileInput& file);

// Returns the value of the tag Orientation; 1 by default. Throws MalformedFile.
uint64_t exif_orientation(std::string_view exif);

// Returns the Exif for new pixels of this size: upright, without the thumbnail of the old ones. Returns an empty string
// for malformed Exif.
std::string exif_for(std::string exif, Extent size);

}  // namespace ods
