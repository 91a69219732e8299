// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/image_codec.h"

#include "ods/image/codec/openimageio.h"

namespace ods {

static constexpr ImageCodec kCodec = {openimageio::read_image,    openimageio::read_info,    openimageio::open_rows,
                                      openimageio::read_channels, openimageio::decode_image, openimageio::write_image};

const ImageCodec& image_codec() {
  return kCodec;
}

}  // namespace ods

// For programs that load this library at run time.
extern "C" const ods::ImageCodec* ods_image_codec() {
  return &ods::kCodec;
}
