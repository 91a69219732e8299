// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/ycbcr.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <vector>

namespace ods {

std::string_view chroma_name(Chroma chroma) {
  switch (chroma) {
    case Chroma::k420:
      return "420";
    case Chroma::k422:
      return "422";
    case Chroma::k444:
      return "444";
  }
  return {};
}

Extent chroma_block(Chroma chroma) {
  return {chroma == Chroma::k444 ? 1 : 2, chroma == Chroma::k420 ? 2 : 1};
}

Planes Planes::at(int x, int y) const {
  const Extent block = chroma_block(chroma);
  assert(x % block.width == 0 && y % block.height == 0);
  const size_t size = bits > 8 ? 2 : 1;
  Planes part = *this;
  for (size_t i = 0; i < 3; i++) {
    const int column = i == 0 ? x : x / block.width, row = i == 0 ? y : y / block.height;
    part.first[i] += static_cast<size_t>(row) * stride[i] + static_cast<size_t>(column) * size;
  }
  return part;
}

static constexpr float kRed = 0.2126f, kGreen = 0.7152f, kBlue = 0.0722f;

// The colour of some rows, not yet of whole numbers.
struct Color {
  std::vector<float> cb, cr;
};

template <typename T>
static void put_row(std::span<const float> row, int bits, T* out, Color& color, float share) {
  const size_t width = row.size() / 3;
  const float *red = row.data(), *green = red + width, *blue = green + width;
  const float unit = static_cast<float>(1 << (bits - 8));
  for (size_t x = 0; x < width; x++) {
    const float luma = kRed * red[x] + kGreen * green[x] + kBlue * blue[x];
    out[x] = static_cast<T>((16.0f + 219.0f * luma) * unit + 0.5f);
    color.cb[x] += (blue[x] - luma) * (share / (2.0f * (1.0f - kBlue)));
    color.cr[x] += (red[x] - luma) * (share / (2.0f * (1.0f - kRed)));
  }
}

template <typename T>
static void put_color(const std::vector<float>& color, int bits, int step, T* out) {
  const float unit = static_cast<float>(1 << (bits - 8));
  const auto code = [&](float value) { return static_cast<T>((128.0f + 224.0f * value) * unit + 0.5f); };
  if (step == 1) {
    for (size_t x = 0; x < color.size(); x++) out[x] = code(color[x]);
    return;
  }
  out[0] = code(0.75f * color[0] + 0.25f * color[1]);
  for (size_t x = 2; x < color.size(); x += 2) {
    out[x / 2] = code(0.5f * color[x] + 0.25f * (color[x - 1] + color[x + 1]));
  }
}

template <typename T>
static void put_blocks(const CodeRows& rows, Extent size, const Planes& planes) {
  const Extent block = chroma_block(planes.chroma);
  const auto row_of = [&](size_t plane, int y) {
    return reinterpret_cast<T*>(planes.first[plane] + static_cast<size_t>(y) * planes.stride[plane]);
  };
  tbb::parallel_for(tbb::blocked_range<int>(0, size.height / block.height, 16), [&](const auto& range) {
    const size_t width = static_cast<size_t>(size.width);
    std::vector<float> row(3 * width);
    Color color;
    for (int y = range.begin(); y != range.end(); y++) {
      color.cb.assign(width, 0.0f);
      color.cr.assign(width, 0.0f);
      for (int line = y * block.height; line < (y + 1) * block.height; line++) {
        rows(line, row);
        put_row(row, planes.bits, row_of(0, line), color, 1.0f / static_cast<float>(block.height));
      }
      put_color(color.cb, planes.bits, block.width, row_of(1, y));
      put_color(color.cr, planes.bits, block.width, row_of(2, y));
    }
  });
}

void put_ycbcr(const CodeRows& rows, Extent size, const Planes& planes) {
  const Extent block = chroma_block(planes.chroma);
  assert(size.width % block.width == 0 && size.height % block.height == 0);
  static_cast<void>(block);
  if (planes.bits == 8) return put_blocks<uint8_t>(rows, size, planes);
  put_blocks<uint16_t>(rows, size, planes);
}

}  // namespace ods
