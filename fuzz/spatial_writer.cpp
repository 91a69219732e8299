// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libFuzzer on writing spatial photos: two HEIC files of any bytes give a spatial photo or an error, and our reader finds
// both eyes and the cameras in it.
//   cmake --preset fuzz && cmake --build --preset fuzz --target fuzz_spatial_writer
//   fuzz/picture_seeds.sh build/release/ods build/pictures
//   build/fuzz/fuzz_spatial_writer -max_len=16384 build/corpus build/pictures/heif
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "ods/base/bytes.h"
#include "ods/base/error.h"
#include "ods/files/memory_file.h"
#include "ods/image/heif_items.h"
#include "ods/image/spatial_photo.h"

// The first two bytes tell where the second file begins; at 0, both eyes are the same file.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 2) return 0;
  const std::string_view all(reinterpret_cast<const char*>(data) + 2, size - 2);
  const size_t begin = (size_t{data[0]} << 8 | data[1]) % (all.size() + 1);
  const std::string_view left = all.substr(0, begin == 0 ? all.size() : begin), right = all.substr(begin);
  std::string photo;
  try {
    photo = ods::make_spatial_photo(left, right, {63.4, 0.019});
  } catch (const ods::MalformedFile&) {
    return 0;
  } catch (const ods::Error&) {
    return 0;
  }
  const ods::MemoryFile file({photo.data(), photo.size()});
  try {
    const ods::HeifItems items = ods::read_heif_items(ods::FileInput(file.path()));
    if (items.pair.size() != 2 || std::abs(items.fov - 63.4f) > 0.1f) std::abort();
  } catch (const ods::MalformedFile&) {
    std::abort();
  }
  return 0;
}
