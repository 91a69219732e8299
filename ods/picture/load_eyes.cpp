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

namespace {

// Decodes the first three channels of a layer to linear light.
class ColorReader {
 public:
  ColorReader(const LayerPixels& layer, Extent size, bool is_float)
      : layer_(layer), width_(size.width), is_float_(is_float) {
    if (!is_float) light_ = linear_from_encoded(layer.sample == SampleType::kUint8 ? 255 : 65535);
  }

  // Passes each pixel of a row to `put`.
  template <class Put>
  void read(int y, Put put) const {
    if (is_float_) {
      read_samples(y, put, [&](const std::byte* at) { return sample_value(layer_.sample, at); });
    } else if (layer_.sample == SampleType::kUint8) {
      read_samples(y, put, [&](const std::byte* at) { return light_[std::to_integer<uint8_t>(*at)]; });
    } else {
      read_samples(y, put, [&](const std::byte* at) {
        uint16_t code;
        std::memcpy(&code, at, sizeof code);
        return light_[code];
      });
    }
  }

 private:
  template <class Put, class Light>
  void read_samples(int y, Put put, Light light) const {
    const size_t step = bytes_of(layer_.sample);
    const std::byte* in = layer_.first + y * layer_.row_stride;
    for (int x = 0; x < width_; x++, in += layer_.pixel_stride) {
      put(x, vec3(light(in), light(in + step), light(in + 2 * step)));
    }
  }

  const LayerPixels& layer_;
  int width_;
  bool is_float_;
  std::vector<float> light_;
};

}  // namespace

// Passes each pixel of a layer to `put`, from several threads.
template <class Put>
static void read_pixels(const LayerPixels& layer, Extent size, bool is_float, Put put) {
  const ColorReader reader(layer, size, is_float);
  tbb::parallel_for(0, size.height, [&](int y) { reader.read(y, [&](int x, vec3 rgb) { put(x, y, rgb); }); });
}

void read_colors(const StoredPicture& picture, size_t eye,
                 const std::function<void(int y, const std::vector<float>& row)>& put) {
  const ColorReader reader(picture.eyes[eye].layers[0], picture.size, picture.is_float);
  std::vector<float> row(3 * static_cast<size_t>(picture.size.width));
  for (int y = 0; y < picture.size.height; y++) {
    reader.read(y, [&](int x, vec3 rgb) { std::copy_n(&rgb.x, 3, &row[3 * static_cast<size_t>(x)]); });
    put(y, row);
  }
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
