// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/load_eyes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "ods/image/tone.h"
#include "ods/kernel/surface.h"

namespace ods {

// Decodes the first three channels of a layer to linear light and passes each pixel to `put`.
template <class Put>
static void read_pixels(const LayerPixels& layer, Extent size, bool is_float, Put put) {
  const size_t step = bytes_of(layer.sample);
  const int largest = layer.sample == SampleType::kUint8 ? 255 : 65535;
  const std::vector<float> light = is_float ? std::vector<float>() : linear_from_encoded(largest);
  tbb::parallel_for(0, size.height, [&](int y) {
    const std::byte* in = layer.first + y * layer.row_stride;
    for (int x = 0; x < size.width; x++, in += layer.pixel_stride) {
      vec3 rgb;
      for (int c = 0; c < 3; c++) {
        const std::byte* at = in + static_cast<size_t>(c) * step;
        uint16_t code = 0;
        if (!is_float) std::memcpy(&code, at, step);
        rgb[c] = is_float ? sample_value(layer.sample, at) : light[code];
      }
      put(x, y, rgb);
    }
  });
}

static Image linear_image(const LayerPixels& layer, Extent size, bool is_float) {
  Image image(size.width, size.height, 3);
  read_pixels(layer, size, is_float, [&](int x, int y, vec3 rgb) { std::copy_n(&rgb.x, 3, image.at(x, y)); });
  return image;
}

std::vector<Image> grey_eyes(const StoredPicture& picture) {
  std::vector<Image> eyes;
  for (const StoredEye& eye : picture.eyes) {
    Image& image = eyes.emplace_back(picture.size.width, picture.size.height, 1);
    read_pixels(eye.layers[0], picture.size, picture.is_float,
                [&](int x, int y, vec3 rgb) { *image.at(x, y) = luminance(rgb); });
  }
  return eyes;
}

static const LayerPixels* find_variance(const StoredEye& eye) {
  for (const LayerPixels& layer : eye.layers) {
    if (layer.channels == std::vector<std::string>{"variance.R", "variance.G", "variance.B"}) return &layer;
  }
  return nullptr;
}

LoadedEyes load_eyes(const std::string& path, std::optional<Layout> layout) {
  OpenOptions options;
  options.format.layout = layout;
  const StoredPicture picture = open_picture(path, options);
  LoadedEyes loaded;
  loaded.guess.reason = picture.layout_reason;
  if (picture.eyes.size() == 2) loaded.guess.layout = picture.layout;
  loaded.projection = projection_name(picture.camera.projection);
  loaded.is_float = picture.is_float;
  loaded.color_fault = picture.color_fault;
  for (const StoredEye& eye : picture.eyes) {
    loaded.eyes.push_back(linear_image(eye.layers[0], picture.size, picture.is_float));
    const LayerPixels* variance = find_variance(eye);
    if (variance) loaded.variance.push_back(linear_image(*variance, picture.size, true));
  }
  return loaded;
}

}  // namespace ods
