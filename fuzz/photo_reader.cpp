// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libFuzzer on VR photos (.vr.jpg): any bytes give two eyes of one size or an error.
//   cmake --preset fuzz && cmake --build --preset fuzz --target fuzz_photo_reader
//   fuzz/picture_seeds.sh build/release/ods build/pictures
//   build/fuzz/fuzz_photo_reader -max_len=16384 build/corpus build/pictures/photo
#include <cstdlib>

#include "ods/base/error.h"
#include "ods/files/memory_file.h"
#include "ods/picture/metadata/vr_photo.h"
#include "ods/picture/stored_picture.h"

constexpr int kManyPixels = 1 << 16;  // decoding more is too slow for many runs

static void read_photo(const std::string& path) {
  const ods::FileInfo info = ods::read_info(path);
  if (int64_t{info.width} * info.height > kManyPixels) return;
  const ods::StoredPicture picture = ods::open_picture(path);
  if (picture.eyes.size() != 2) return;  // its metadata specifies another layout
  for (const ods::StoredEye& eye : picture.eyes) {
    for (const ods::LayerPixels& layer : eye.layers) {
      const std::byte* last =
          layer.first + (picture.size.height - 1) * layer.row_stride + (picture.size.width - 1) * layer.pixel_stride;
      volatile std::byte seen = *layer.first;  // the sanitizer checks that they exist
      seen = *last;
      static_cast<void>(seen);
    }
  }
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const ods::MemoryFile file({reinterpret_cast<const char*>(data), size});
  try {
    if (!ods::is_photo(file.path())) return 0;
    read_photo(file.path());
  } catch (const ods::Error&) {
  }
  return 0;
}
