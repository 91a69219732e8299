// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libFuzzer on HEIC and AVIF: any bytes give a picture or an error. Our own reader of their boxes runs first, then
// libheif, which must not use more memory or time than for a small picture.
//   cmake --preset fuzz && cmake --build --preset fuzz --target fuzz_heif_reader
//   fuzz/picture_seeds.sh build/release/ods build/pictures
//   build/fuzz/fuzz_heif_reader -max_len=16384 -rss_limit_mb=1024 -timeout=20 build/corpus build/pictures/heif
#include <cmath>
#include <cstdlib>

#include "ods/base/bytes.h"
#include "ods/base/error.h"
#include "ods/files/memory_file.h"
#include "ods/image/heif_items.h"
#include "ods/picture/stored_picture.h"

constexpr int kManyPixels = 1 << 16;  // decoding more is too slow for many runs

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const ods::MemoryFile file({reinterpret_cast<const char*>(data), size});
  const std::string path = file.path();
  try {
    const ods::HeifItems items = ods::read_heif_items(ods::FileInput(path));
    if (!items.pair.empty() && items.pair.size() != 2) std::abort();
    if (!(items.fov >= 0.0f && items.fov < 180.0f)) std::abort();
  } catch (const ods::MalformedFile&) {
    return 0;
  }
  try {
    const ods::FileInfo info = ods::read_info(path);
    if (int64_t{info.width} * info.height <= kManyPixels) ods::open_picture(path);
  } catch (const ods::Error&) {
  }
  return 0;
}
