// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/image_codec.h"

#include "ods/image/codec/openimageio.h"

namespace ods {

const ImageCodec& image_codec() {
  return openimageio::codec();
}

}  // namespace ods
