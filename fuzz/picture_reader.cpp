// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libFuzzer on the reader of pictures, and on converting them: any bytes give a picture or an error, and a converted
// picture has no NaN.
//   cmake --preset fuzz && cmake --build --preset fuzz --target fuzz_picture_reader
//   build/fuzz/fuzz_picture_reader -max_len=16384 folder/of/small/pictures
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "ods/base/error.h"
#include "ods/convert/convert.h"
#include "ods/files/memory_file.h"

constexpr int kManyPixels = 1 << 16;  // converting more is too slow for many runs

static void convert_picture(const ods::StoredPicture& picture) {
  ods::ConvertTarget target;
  target.camera = picture.camera;
  target.camera.projection = ods::find_projection("cube-3x2")->setting;
  target.eye = {24, 16};
  target.eyes = {ods::kMono};
  if (!ods::conversion_fault(picture, target).empty()) return;
  const ods::Conversion conversion = ods::convert(picture, target);
  std::vector<float> row(24 * count_channels(conversion.rows.layers));
  for (int y = 0; y < 16; y++) {
    conversion.rows.fill(0, y, row);
    if (std::any_of(row.begin(), row.end(), [](float value) { return std::isnan(value); })) std::abort();
  }
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const ods::MemoryFile file({reinterpret_cast<const char*>(data), size});
  try {
    const std::string path = file.path();
    const ods::FileInfo info = ods::read_info(path);
    if (int64_t{info.width} * info.height <= kManyPixels) convert_picture(ods::open_picture(path));
  } catch (const ods::Error&) {
  }
  return 0;
}
