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

namespace {

// The colour of some rows, not yet of whole numbers.
struct Color {
  std::vector<float> cb, cr;
};

}  // namespace

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

// --- the way back ----------------------------------------------------------------------------------------------------

// One colour of row y at columns first, first + 1 ..., still as numbers.
template <typename T>
static void get_color(const Planes& planes, Extent size, size_t plane, int y, int first, std::span<float> out) {
  const Extent block = chroma_block(planes.chroma);
  const Extent whole{size.width / block.width, size.height / block.height};
  const auto row_of = [&](int row) {
    row = std::clamp(row, 0, whole.height - 1);
    return reinterpret_cast<const T*>(planes.first[plane] + static_cast<size_t>(row) * planes.stride[plane]);
  };
  const T* near = row_of(y / block.height);
  const T* far = block.height == 1 ? near : row_of(y / 2 + (y % 2 == 0 ? -1 : 1));
  const float share = block.height == 1 ? 1.0f : 0.75f;
  const auto at = [&](int column) {
    const int x = std::min(column, whole.width - 1);
    return share * static_cast<float>(near[x]) + (1.0f - share) * static_cast<float>(far[x]);
  };
  for (size_t i = 0; i < out.size(); i++) {
    const int x = first + static_cast<int>(i), column = x / block.width;
    out[i] = x % block.width == 0 ? at(column) : 0.5f * (at(column) + at(column + 1));
  }
}

template <typename T>
static void get_row(const Planes& planes, Extent size, const ColorCode& color, int y, int first, std::span<float> row) {
  const size_t width = row.size() / 3;
  const std::span<float> red = row.first(width), green = row.subspan(width, width), blue = row.subspan(2 * width);
  get_color<T>(planes, size, 1, y, first, blue);
  get_color<T>(planes, size, 2, y, first, red);
  const T* luma = reinterpret_cast<const T*>(planes.first[0] + static_cast<size_t>(y) * planes.stride[0]) + first;
  const float unit = static_cast<float>(1 << (planes.bits - 8)), most = static_cast<float>((1 << planes.bits) - 1);
  const float black = color.has_full_range ? 0.0f : 16.0f * unit, grey = 128.0f * unit;
  const float luma_scale = 1.0f / (color.has_full_range ? most : 219.0f * unit);
  const float color_scale = 1.0f / (color.has_full_range ? most : 224.0f * unit);
  const float kr = color.is_601 ? 0.299f : kRed, kb = color.is_601 ? 0.114f : kBlue, kg = 1.0f - kr - kb;
  for (size_t i = 0; i < width; i++) {
    const float y_code = (static_cast<float>(luma[i]) - black) * luma_scale;
    const float b = y_code + 2.0f * (1.0f - kb) * (blue[i] - grey) * color_scale;
    const float r = y_code + 2.0f * (1.0f - kr) * (red[i] - grey) * color_scale;
    red[i] = r, blue[i] = b, green[i] = (y_code - kr * r - kb * b) / kg;
  }
}

void get_codes(const Planes& planes, Extent size, const ColorCode& color, int y, int first, std::span<float> row) {
  assert(first >= 0 && first + static_cast<int>(row.size() / 3) <= size.width);
  if (planes.bits == 8) return get_row<uint8_t>(planes, size, color, y, first, row);
  get_row<uint16_t>(planes, size, color, y, first, row);
}

void put_ycbcr(const CodeRows& rows, Extent size, const Planes& planes) {
  const Extent block = chroma_block(planes.chroma);
  assert(size.width % block.width == 0 && size.height % block.height == 0);
  static_cast<void>(block);
  if (planes.bits == 8) return put_blocks<uint8_t>(rows, size, planes);
  put_blocks<uint16_t>(rows, size, planes);
}

}  // namespace ods
