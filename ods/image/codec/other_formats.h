// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// TIFF, WebP and HDR go through OpenImageIO (ods/image/openimageio); a program links it, or loads it when it meets its
// first such file. Debian's OpenImageIO brings some 250 libraries, which take a third of a second to load and 100 MB:
// the command `ods` loads them when it needs them. Programs that link the library can ignore this.
#pragma once
#include "ods/image/codec/decoder.h"
#include "ods/image/codec/encoder.h"

namespace ods {

// As open_png() and create_png().
struct OtherFormats {
  std::unique_ptr<Decoder> (*open)(const PictureBytes& file, FileFormat format);
  std::unique_ptr<Encoder> (*create)(AtomicFile& file, const FileHeader& header);
};

// Those of this program: ods/image/openimageio's, unless the program defines this function itself. The command `ods`
// and the tests do, in cli/load_images.cpp.
const OtherFormats& other_formats();

}  // namespace ods
