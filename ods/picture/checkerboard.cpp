// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/checkerboard.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "ods/files/scratch.h"
#include "ods/image/tone.h"

namespace ods {
namespace {

bool is_float(SampleType sample) {
  return sample == SampleType::kHalf || sample == SampleType::kFloat;
}

size_t pixel_size(const LayerPixels& layer) {
  return layer.channels.size() * bytes_of(layer.sample);
}

const std::byte* pixel_at(const LayerPixels& layer, int x, int y) {
  return layer.first + y * layer.row_stride + x * layer.pixel_stride;
}

// Converts code values to light multiplied by alpha; other numbers are not changed.
void read_pixel(const LayerPixels& layer, const std::byte* at, std::vector<float>& values) {
  const size_t count = layer.channels.size();
  for (size_t c = 0; c < count; c++) values[c] = sample_value(layer.sample, at + c * bytes_of(layer.sample));
  if (is_float(layer.sample)) return;
  const float alpha = count == 4 ? values[3] : 1.0f;
  for (size_t c = 0; c < 3; c++) values[c] = srgb_decode(values[c]) * alpha;
}

template <class T>
void write_codes(const std::vector<float>& values, float largest, std::byte* to) {
  const float alpha = values.size() == 4 ? values[3] : 1.0f;
  for (size_t c = 0; c < values.size(); c++, to += sizeof(T)) {
    const float code = c == 3 ? alpha : alpha > 0.0f ? srgb_encode(values[c] / alpha) : 0.0f;
    const T rounded = static_cast<T>(std::clamp(code, 0.0f, 1.0f) * largest + 0.5f);
    std::memcpy(to, &rounded, sizeof(T));
  }
}

void write_mean(const LayerPixels& layer, const std::vector<float>& values, std::byte* to) {
  switch (layer.sample) {
    case SampleType::kUint8:
      return write_codes<uint8_t>(values, 255.0f, to);
    case SampleType::kUint16:
      return write_codes<uint16_t>(values, 65535.0f, to);
    case SampleType::kHalf:
    case SampleType::kFloat:
      pack_floats(std::vector<SampleType>(values.size(), layer.sample), values, to);
  }
}

void fill_from_neighbours(const LayerPixels& layer, const Neighbours& from, std::byte* to) {
  std::vector<float> sum(layer.channels.size()), values(layer.channels.size());
  const std::byte* nearest = nullptr;
  for (int i = 0; i < from.count; i++) {
    const std::byte* at = pixel_at(layer, from.x[i], from.y[i]);
    const bool is_nearer = nearest == nullptr || sample_value(layer.sample, at) < sample_value(layer.sample, nearest);
    if (is_nearer) nearest = at;
    if (layer.rule == LayerRule::kNearest) continue;
    read_pixel(layer, at, values);
    for (size_t c = 0; c < sum.size(); c++) sum[c] += values[c] / static_cast<float>(from.count);
  }
  if (layer.rule == LayerRule::kNearest) {
    std::memcpy(to, nearest, pixel_size(layer));
  } else {
    write_mean(layer, sum, to);
  }
}

// Copies the layer of one eye, row by row, to `to`.
LayerPixels take_out(const LayerPixels& layer, int index, Extent size, std::byte* to) {
  LayerPixels own = layer;
  own.first = to;
  own.pixel_stride = static_cast<ptrdiff_t>(pixel_size(layer));
  own.row_stride = own.pixel_stride * size.width;
  tbb::parallel_for(0, size.height, [&](int y) {
    std::byte* out = to + y * own.row_stride;
    for (int x = 0; x < size.width; x++, out += own.pixel_stride) {
      if (is_left_out(index, x, y)) {
        fill_from_neighbours(layer, neighbours_of(x, y, size), out);
      } else {
        std::memcpy(out, pixel_at(layer, x, y), pixel_size(layer));
      }
    }
  });
  return own;
}

}  // namespace

void take_checkerboard_apart(StoredPicture& picture, const OpenOptions& options) {
  const size_t pixels = static_cast<size_t>(picture.size.width) * static_cast<size_t>(picture.size.height);
  size_t bytes = 0;
  for (const StoredEye& eye : picture.eyes) {
    for (const LayerPixels& layer : eye.layers) bytes += pixels * pixel_size(layer);
  }
  const auto memory = std::make_shared<Scratch>(bytes, options.scratch_folder, options.max_in_memory);
  std::byte* to = memory->data();
  for (size_t i = 0; i < picture.eyes.size(); i++) {
    for (LayerPixels& layer : picture.eyes[i].layers) {
      layer = take_out(layer, static_cast<int>(i), picture.size, to);
      to += pixels * pixel_size(layer);
      memory->release();
    }
  }
  picture.memory = memory;
}

}  // namespace ods
