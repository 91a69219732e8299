// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the colour space of a picture file from the place where its format stores it:
//
//   PNG    the first of cICP, iCCP, sRGB, gAMA with cHRM, as the PNG specification (third edition) ranks them
//   JPEG   an ICC profile in APP2
//   TIFF   an ICC profile, else TransferFunction, WhitePoint and PrimaryChromaticities
//   WebP   an ICC profile
//   HEIF   an ICC profile, else nclx
//   EXR    chromaticities
//
// A gAMA within 5 % of 1/2.2 counts as sRGB, as in libpng, because programs write 0.45455 for sRGB.
#pragma once
#include <string>

#include "ods/image/color_space.h"
#include "ods/image/format/file_format.h"

namespace ods {

struct FileInfo;

// Returns the default colour space if the file does not specify one, or cannot be read, in which case reading its
// pixels reports the error. Floats are always linear: only the primaries of a float file are used, and a transfer curve
// is a fault.
ColorSpace read_color_space(const std::string& path, FileFormat format, const FileInfo& info);

}  // namespace ods
