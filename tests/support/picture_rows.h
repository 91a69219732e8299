// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture with layers that a test saves, and examines pixel by pixel after opening it again.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "ods/image/tone.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"

namespace ods {

inline constexpr int kWidth = 32, kHeight = 16;

inline float light(int eye, int x, int y, int c) {
  const float side = eye == kLeft ? 0.15f : eye == kRight ? 0.45f : 0.3f;
  return side + 0.006f * static_cast<float>(x) + 0.004f * static_cast<float>(y) + 0.01f * static_cast<float>(c);
}

// Colour (with alpha, which is 1 except in the first column), depth, normals.
inline PictureRows picture_rows(const std::vector<int>& eyes, bool alpha, bool layers) {
  PictureRows rows;
  rows.eye = {kWidth, kHeight};
  rows.eyes = eyes;
  rows.layers = {{{"R", "G", "B"}, LayerRule::kLight, SampleType::kHalf}};
  if (alpha) rows.layers[0].channels.push_back("A");
  if (layers) {
    rows.layers.push_back({{"Z"}, LayerRule::kNearest, SampleType::kFloat});
    rows.layers.push_back({{"N.X", "N.Y", "N.Z"}, LayerRule::kMean, SampleType::kHalf});
  }
  rows.fill = [=](int index, int y, std::span<float> row) {
    const int eye = eyes[static_cast<size_t>(index)];
    float* out = row.data();
    for (int x = 0; x < kWidth; x++) {
      const float opacity = alpha && x == 0 ? 0.5f : 1.0f;
      for (int c = 0; c < 3; c++) *out++ = opacity * light(eye, x, y, c);
      if (alpha) *out++ = opacity;
      if (!layers) continue;
      *out++ = 100.0f + light(eye, x, y, 0);
      for (int c = 0; c < 3; c++) *out++ = light(eye, x, y, c) - 0.5f;
    }
  };
  return rows;
}

inline float value_at(const LayerPixels& layer, int x, int y, size_t c) {
  return sample_value(layer.sample,
                      layer.first + x * layer.pixel_stride + y * layer.row_stride + c * bytes_of(layer.sample));
}

inline float light_at(const StoredPicture& picture, const StoredEye& eye, int x, int y, size_t c) {
  const float value = value_at(eye.layers[0], x, y, c);
  return picture.is_float ? value : srgb_decode(value);
}

inline OpenOptions as(std::optional<Layout> layout) {
  OpenOptions options;
  options.format.layout = layout;
  return options;
}

}  // namespace ods
