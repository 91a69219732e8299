// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/unwrap.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>

#include "ods/convert/convert.h"
#include "ods/files/scratch.h"

namespace ods {

StoredPicture unwrapped(const StoredPicture& picture) {
  assert(!picture.maps.empty());
  ConvertTarget target = same_format(picture);
  target.eye = picture.size;
  const Conversion conversion = convert(picture, target);
  const size_t channels = count_channels(conversion.rows.layers), width = static_cast<size_t>(picture.size.width);
  const size_t row_bytes = 3 * width * sizeof(float), eye_bytes = row_bytes * static_cast<size_t>(picture.size.height);
  StoredPicture result = picture;
  result.maps.clear();
  result.front_and_back = false;
  result.is_float = true;
  result.eyes.clear();
  result.memory = std::make_shared<Scratch>(eye_bytes * target.eyes.size(), "", 0);
  for (size_t i = 0; i < target.eyes.size(); i++) {
    std::byte* const to = result.memory->data() + i * eye_bytes;
    tbb::parallel_for(0, picture.size.height, [&](int y) {
      std::vector<float> row(channels * width);
      conversion.rows.fill(static_cast<int>(i), y, row);
      auto* out = reinterpret_cast<float*>(to + static_cast<size_t>(y) * row_bytes);
      for (size_t x = 0; x < width; x++) out = std::copy_n(&row[x * channels], 3, out);
    });
    StoredEye& eye = result.eyes.emplace_back();
    eye.eye = target.eyes[i];
    eye.layers.push_back({{"R", "G", "B"},
                          LayerRule::kLight,
                          SampleType::kFloat,
                          to,
                          static_cast<ptrdiff_t>(3 * sizeof(float)),
                          static_cast<ptrdiff_t>(row_bytes)});
  }
  return result;
}

}  // namespace ods
