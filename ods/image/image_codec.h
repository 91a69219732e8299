// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What decodes and encodes image files, as functions that a program may link or open when it meets its first image.
// Debian's OpenImageIO brings some 250 libraries with it, which take a quarter of a second to load and 100 MB: the
// command `ods` opens them when it needs them. Programs that link the library need not know of this.
#pragma once
#include "ods/image/image_file.h"

namespace ods {

// Each is the function of image_file.h that has its name.
struct ImageCodec {
  decltype(&ods::read_image) read_image;
  decltype(&ods::read_info) read_info;
  decltype(&ods::open_rows) open_rows;
  decltype(&ods::read_channels) read_channels;
  decltype(&ods::decode_image) decode_image;
  decltype(&ods::write_image) write_image;
};

// The one of this program: ods/image/codec's, unless the program defines this function itself, as `ods` does.
const ImageCodec& image_codec();

}  // namespace ods
