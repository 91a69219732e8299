// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/ycbcr.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <vector>

#include "ods/base/wide.h"

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

namespace {

// The weights of the primaries in the luma.
struct Weights {
  float red = 0.2126f, green = 0.7152f, blue = 0.0722f;
};

// Converts a value of luma (0..1) or chroma (-0.5..0.5) to a code.
struct Scale {
  float luma_zero, luma, chroma_zero, chroma;  // at 8 bits
  float unit;                                  // one step of 8 bits, in codes of this bit depth
  float maximum;                               // maximum code
};

// The chroma of several rows, before rounding.
struct Color {
  std::vector<float> cb, cr;
};

}  // namespace

static Weights weights_of(YcbcrMatrix matrix) {
  switch (matrix) {
    case YcbcrMatrix::k709:
      break;
    case YcbcrMatrix::k601:
      return {0.299f, 1.0f - 0.299f - 0.114f, 0.114f};
    case YcbcrMatrix::k2020:
      return {0.2627f, 1.0f - 0.2627f - 0.0593f, 0.0593f};
  }
  return {};
}

static Scale scale_of(int bits, bool has_full_range) {
  const float unit = static_cast<float>(1 << (bits - 8)), maximum = static_cast<float>((1 << bits) - 1);
  if (has_full_range) return {0.0f, maximum / unit, 128.0f, maximum / unit, unit, maximum};
  return {16.0f, 219.0f, 128.0f, 224.0f, unit, maximum};
}

template <typename T>
ODS_WIDE static void put_row(std::span<const float> row, const Weights& weights, const Scale& scale, T* out,
                             Color& color, float share) {
  const size_t width = row.size() / 3;
  const float *red = row.data(), *green = red + width, *blue = green + width;
  for (size_t x = 0; x < width; x++) {
    const float luma = weights.red * red[x] + weights.green * green[x] + weights.blue * blue[x];
    const float number = (scale.luma_zero + scale.luma * luma) * scale.unit + 0.5f;
    out[x] = static_cast<T>(std::clamp(number, 0.0f, scale.maximum));
    color.cb[x] += (blue[x] - luma) * (share / (2.0f * (1.0f - weights.blue)));
    color.cr[x] += (red[x] - luma) * (share / (2.0f * (1.0f - weights.red)));
  }
}

template <typename T>
ODS_WIDE static void put_color(const std::vector<float>& color, const Scale& scale, int step, T* out) {
  const auto code = [&](float value) {
    const float number = (scale.chroma_zero + scale.chroma * value) * scale.unit + 0.5f;
    return static_cast<T>(std::clamp(number, 0.0f, scale.maximum));
  };
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
static void put_blocks(const CodeBands& bands, Extent size, const Planes& planes, const ColorCode& code) {
  const Extent block = chroma_block(planes.chroma);
  const Weights weights = weights_of(code.matrix);
  const Scale scale = scale_of(planes.bits, code.has_full_range);
  const auto row_of = [&](size_t plane, int y) {
    return reinterpret_cast<T*>(planes.first[plane] + static_cast<size_t>(y) * planes.stride[plane]);
  };
  tbb::parallel_for(0, (size.height + kMaxCodeRows - 1) / kMaxCodeRows, [&](int band) {
    const size_t width = static_cast<size_t>(size.width);
    const int top = band * kMaxCodeRows, count = std::min(kMaxCodeRows, size.height - top);
    thread_local std::vector<float> rows;
    thread_local Color color;
    rows.resize(3 * width * static_cast<size_t>(count));
    bands(top, count, rows);
    for (int y = top; y < top + count; y++) {
      if (y % block.height == 0) color.cb.assign(width, 0.0f), color.cr.assign(width, 0.0f);
      const std::span<const float> row = std::span(rows).subspan(3 * width * static_cast<size_t>(y - top), 3 * width);
      put_row(row, weights, scale, row_of(0, y), color, 1.0f / static_cast<float>(block.height));
      if ((y + 1) % block.height != 0) continue;
      put_color(color.cb, scale, block.width, row_of(1, y / block.height));
      put_color(color.cr, scale, block.width, row_of(2, y / block.height));
    }
  });
}

// --- decoding --------------------------------------------------------------------------------------------------------

// One chroma plane at row y, columns first, first + 1, ..., as raw numbers.
template <typename T>
ODS_WIDE static void get_color(const Planes& planes, Extent size, size_t plane, int y, int first,
                               std::span<float> out) {
  const Extent block = chroma_block(planes.chroma);
  const Extent whole{size.width / block.width, size.height / block.height};
  const auto row_of = [&](int row) {
    row = std::clamp(row, 0, whole.height - 1);
    return reinterpret_cast<const T*>(planes.first[plane] + static_cast<size_t>(row) * planes.stride[plane]);
  };
  const T* near = row_of(y / block.height);
  const T* far = block.height == 1 ? near : row_of(y / 2 + (y % 2 == 0 ? -1 : 1));
  const float share = block.height == 1 ? 1.0f : 0.75f, rest = 1.0f - share;
  const int count = static_cast<int>(out.size());
  if (block.width == 1) {
    for (int i = 0; i < count; i++) {
      out[static_cast<size_t>(i)] =
          share * static_cast<float>(near[first + i]) + rest * static_cast<float>(far[first + i]);
    }
    return;
  }
  // The samples of this row, with the last one repeated: pixels between two samples have their mean.
  const int column = first / 2, samples = (first + count - 1) / 2 - column + 2;
  thread_local std::vector<float> row;
  row.resize(static_cast<size_t>(samples));
  const int inside = std::min(samples, whole.width - column);
  for (int i = 0; i < inside; i++) {
    row[static_cast<size_t>(i)] =
        share * static_cast<float>(near[column + i]) + rest * static_cast<float>(far[column + i]);
  }
  if (inside < samples) row[static_cast<size_t>(inside)] = row[static_cast<size_t>(inside) - 1];
  const float* at = row.data();
  float* to = out.data();
  int i = 0;
  if (first % 2 != 0) to[i++] = 0.5f * (at[0] + at[1]), at++;
  for (; i + 1 < count; i += 2, at++) to[i] = at[0], to[i + 1] = 0.5f * (at[0] + at[1]);
  if (i < count) to[i] = at[0];
}

template <typename T>
ODS_WIDE static void get_row(const Planes& planes, Extent size, const ColorCode& color, int y, int first,
                             std::span<float> row) {
  const size_t width = row.size() / 3;
  const std::span<float> red = row.first(width), green = row.subspan(width, width), blue = row.subspan(2 * width);
  get_color<T>(planes, size, 1, y, first, blue);
  get_color<T>(planes, size, 2, y, first, red);
  const T* luma = reinterpret_cast<const T*>(planes.first[0] + static_cast<size_t>(y) * planes.stride[0]) + first;
  const Weights weights = weights_of(color.matrix);
  const Scale scale = scale_of(planes.bits, color.has_full_range);
  const float black = scale.luma_zero * scale.unit, grey = scale.chroma_zero * scale.unit;
  const float luma_scale = 1.0f / (scale.luma * scale.unit), color_scale = 1.0f / (scale.chroma * scale.unit);
  const float kr = weights.red, kb = weights.blue, kg = 1.0f - kr - kb;
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

void put_ycbcr_bands(const CodeBands& bands, Extent size, const Planes& planes, const ColorCode& color) {
  const Extent block = chroma_block(planes.chroma);
  assert(size.width % block.width == 0 && size.height % block.height == 0);
  static_cast<void>(block);
  if (planes.bits == 8) return put_blocks<uint8_t>(bands, size, planes, color);
  put_blocks<uint16_t>(bands, size, planes, color);
}

void put_ycbcr(const CodeRows& rows, Extent size, const Planes& planes, const ColorCode& color) {
  const size_t length = 3 * static_cast<size_t>(size.width);
  const auto bands = [&](int y, int count, std::span<float> all) {
    for (int i = 0; i < count; i++) rows(y + i, all.subspan(static_cast<size_t>(i) * length, length));
  };
  put_ycbcr_bands(bands, size, planes, color);
}

}  // namespace ods
