// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The shape of a picture's pixels, and the place of the picture in a larger one, by its metadata. Sources: ITU-T T.871
// (JFIF), ISO/IEC 15948 (PNG), Adobe, "TIFF Revision 6.0", section 8; Pixar's tags of the full size, as Hugin's nona
// writes them into cropped TIFFs.
#pragma once
#include <optional>
#include <string_view>

#include "ods/files/file_input.h"
#include "ods/image/format/file_format.h"
#include "ods/image/format/file_info.h"

namespace ods {

// Keys of FileInfo::numbers: width over height of a pixel; left, top, width and height of the larger picture. Absent
// for square pixels, and for a picture that is whole.
inline constexpr std::string_view kPixelAspect = "pixel:aspect", kWholeArea = "tiff:whole";

// Sets them from resolutions that differ in X and Y (JPEG, PNG, TIFF), and from XPosition and full size (TIFF).
// FileInfo::text receives kPixelDoubt if the file has only a ratio, which some programs write upside down. orientation:
// as in ods/image/orientation.h; the size in `info` is the size after turning.
inline constexpr std::string_view kPixelDoubt = "pixel:doubt";
void read_pixel_place(const FileInput& file, FileFormat format, int orientation, FileInfo& info);

// The same number, or 1 if it hardly differs from 1, or is not a pixel's.
double plausible_aspect(double aspect);

// Width over height of a pixel; 1 if the file does not have it.
double pixel_aspect(const FileInfo& info);

}  // namespace ods
