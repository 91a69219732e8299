// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libFuzzer on the reader of KTX2 textures: any bytes give a picture of the size in their header, or an error.
//   cmake --preset fuzz && cmake --build --preset fuzz --target fuzz_texture_reader
//   build/fuzz/fuzz_texture_reader -max_len=8192 FOLDER tests/image/codec
#include <cstdlib>

#include "ods/base/error.h"
#include "ods/image/codec/ktx2.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  // Large pictures are too slow for many runs.
  if (size > 28 && (data[22] | data[23] | data[26] | data[27]) != 0) return 0;
  try {
    const ods::CodeImage image = ods::decode_ktx2(std::as_bytes(std::span(data, size)), "fuzz.ktx2");
    if (image.pixels.size() != static_cast<size_t>(image.width) * static_cast<size_t>(image.height)) std::abort();
  } catch (const ods::Error&) {
  }
  return 0;
}
