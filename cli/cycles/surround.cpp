// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/cycles/surround.h"

#include "ods/files/atomic_file.h"
#include "ods/image/image_file.h"

void write_surround(const ods::Environment& environment, const std::string& path) {
  const bool is_uniform = environment.width == 0;
  ods::FileHeader header;
  header.format = ods::FileFormat::kExr;
  header.width = is_uniform ? 2 : environment.width;
  header.height = is_uniform ? 1 : environment.height;
  for (const char* const channel : {"R", "G", "B"}) header.channels.push_back({channel, ods::SampleType::kFloat});
  ods::AtomicFile file(path);
  ods::write_image(file, header, [&](int y, std::span<float> row) {
    for (size_t i = 0; i < row.size(); i++) {
      const int channel = static_cast<int>(i % 3);
      const size_t texel = static_cast<size_t>(y) * static_cast<size_t>(environment.width) + i / 3;
      row[i] = environment.radiance[channel] * (is_uniform ? 1.0f : environment.texels[texel][channel]);
    }
  });
  file.commit();
}
