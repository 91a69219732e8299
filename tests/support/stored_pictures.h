// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Stored pictures made in memory, and their conversion to images.
#pragma once
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ods/convert/convert.h"

namespace ods {

struct MadePicture {
  StoredPicture picture;
  std::vector<std::vector<std::byte>> memory;  // memory of each eye's layers
};

// The values of a pixel, of every eye by its home.
using PixelFunction = std::function<void(int eye, vec2 uv, float* out)>;

inline std::vector<StoredEye> empty_eyes(const std::vector<int>& eyes) {
  std::vector<StoredEye> all;
  for (const int eye : eyes) all.push_back({eye, {}});
  return all;
}

inline MadePicture make_picture(const StereoCamera& camera, Extent size, const std::vector<int>& eyes) {
  MadePicture made;
  made.picture.size = size;
  made.picture.camera = camera;
  made.picture.eyes = empty_eyes(eyes);
  return made;
}

// A layer of floats, or of codes; for codes the function returns the code's value, 0..255.
template <class T>
void add_layer(MadePicture& made, const std::vector<std::string>& channels, LayerRule rule, SampleType sample,
               const PixelFunction& value) {
  const Extent size = made.picture.size;
  const size_t count = channels.size(), width = static_cast<size_t>(size.width);
  for (StoredEye& eye : made.picture.eyes) {
    std::vector<std::byte> bytes(width * static_cast<size_t>(size.height) * count * sizeof(T));
    std::vector<float> pixel(count);
    for (int y = 0; y < size.height; y++) {
      for (int x = 0; x < size.width; x++) {
        const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(size.width),
                      (static_cast<float>(y) + 0.5f) / static_cast<float>(size.height));
        value(eye.eye, uv, pixel.data());
        const size_t at = (static_cast<size_t>(y) * width + static_cast<size_t>(x)) * count;
        for (size_t c = 0; c < count; c++) {
          const T sample_value = static_cast<T>(pixel[c]);
          std::memcpy(bytes.data() + (at + c) * sizeof(T), &sample_value, sizeof(T));
        }
      }
    }
    made.memory.push_back(std::move(bytes));
    const ptrdiff_t stride = static_cast<ptrdiff_t>(count * sizeof(T));
    eye.layers.push_back({channels, rule, sample, made.memory.back().data(), stride, stride * size.width});
  }
}

inline void add_colour(MadePicture& made, const PixelFunction& value) {
  add_layer<float>(made, {"R", "G", "B"}, LayerRule::kLight, SampleType::kFloat, value);
}

inline int channels_of(const PictureRows& rows) {
  return static_cast<int>(count_channels(rows.layers));
}

inline std::vector<Image> images_of(const PictureRows& rows) {
  std::vector<Image> images;
  for (size_t i = 0; i < rows.eyes.size(); i++) {
    Image image(rows.eye.width, rows.eye.height, channels_of(rows));
    const size_t width = static_cast<size_t>(image.width) * static_cast<size_t>(image.channels);
    for (int y = 0; y < image.height; y++) rows.fill(static_cast<int>(i), y, {image.at(0, y), width});
    images.push_back(std::move(image));
  }
  return images;
}

// The same eyes with another projection and size.
inline ConvertTarget target_of(const MadePicture& made, const ProjectionSetting& projection, Extent size) {
  ConvertTarget target = same_format(made.picture);
  target.camera.projection = projection;
  target.eye = size;
  return target;
}

inline ProjectionSetting projection_named(const std::string& name) {
  return find_projection(name)->setting;
}

}  // namespace ods
