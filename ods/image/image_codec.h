// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The functions that decode and encode image files; a program links them, or loads them when it opens its first image.
// Debian's OpenImageIO brings some 250 libraries, which take a quarter of a second to load and 100 MB: the command
// `ods` loads them when it needs them. Programs that link the library can ignore this.
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

// The codec of this program: ods/image/codec's, unless the program defines this function itself. The command `ods`
// and the tests do, in cli/load_images.cpp.
const ImageCodec& image_codec();

}  // namespace ods
