// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libFuzzer on depth files: any bytes give depth of a picture in metres, or an error. The first byte selects the
// meaning of the numbers.
//   cmake --preset fuzz && cmake --build --preset fuzz --target fuzz_depth_reader
//   fuzz/depth_seeds.py build/depth
//   build/fuzz/fuzz_depth_reader -max_len=8192 build/corpus build/depth
#include <cmath>
#include <cstdlib>

#include "ods/base/error.h"
#include "ods/depth/picture_depth.h"
#include "ods/files/memory_file.h"

constexpr int64_t kManyPixels = 1 << 12;  // more are too slow for many runs

// A picture of any colours, of the same size as its depth.
static ods::StoredPicture picture_of(const ods::Image& numbers, const std::vector<uint8_t>& colors) {
  ods::StoredPicture picture;
  picture.size = {numbers.width, numbers.height};
  ods::LayerPixels layer{{"R", "G", "B"}, ods::LayerRule::kLight, ods::SampleType::kUint8, nullptr, 3, 0};
  layer.first = reinterpret_cast<const std::byte*>(colors.data());
  layer.row_stride = 3 * numbers.width;
  picture.eyes.push_back({ods::kMono, {layer}});
  return picture;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 2) return 0;
  const ods::MemoryFile file({reinterpret_cast<const char*>(data + 1), size - 1});
  ods::DepthOptions options;
  options.format.kind = ods::kDepthKindTable[data[0] % std::size(ods::kDepthKindTable)].member;
  if (data[0] & 8) options.format.nearest = 0.5f;
  if (data[0] & 16) options.format.farthest = 20.0f;
  if (data[0] & 32) options.eye_height = 1.6f;
  if (data[0] & 64) options.edges = ods::DepthEdges::kSoft;
  try {
    const ods::DepthNumbers depth = ods::read_depth_numbers(file.path());
    const ods::Image& numbers = depth.numbers;
    if (int64_t{numbers.width} * numbers.height > kManyPixels) return 0;
    std::vector<uint8_t> colors(3 * numbers.pixels.size());
    for (size_t i = 0; i < colors.size(); i++) colors[i] = static_cast<uint8_t>(data[i % size]);
    ods::StoredPicture picture = picture_of(numbers, colors);
    ods::add_depth(picture, {depth}, options);
    const auto* metres = reinterpret_cast<const float*>(picture.eyes[0].layers.back().first);
    for (size_t i = 0; i < numbers.pixels.size(); i++) {
      if (!(metres[i] > 0.0f) || !std::isfinite(metres[i])) std::abort();
    }
  } catch (const ods::Error&) {
  }
  return 0;
}
