// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/load_eyes.h"

#include <tbb/parallel_for.h>

#include "ods/image/stored_picture.h"
#include "ods/image/tone.h"

namespace ods {

// The first three channels of a layer.
static Image linear_image(const LayerPixels& layer, Extent size, bool is_float) {
  Image image(size.width, size.height, 3);
  const size_t step = bytes_of(layer.sample);
  tbb::parallel_for(0, size.height, [&](int y) {
    const std::byte* in = layer.first + y * layer.row_stride;
    float* out = image.at(0, y);
    for (int x = 0; x < size.width; x++, in += layer.pixel_stride) {
      for (size_t c = 0; c < 3; c++) {
        const float value = sample_value(layer.sample, in + c * step);
        *out++ = is_float ? value : srgb_decode(value);
      }
    }
  });
  return image;
}

static const LayerPixels* find_variance(const StoredEye& eye) {
  for (const LayerPixels& layer : eye.layers) {
    if (layer.channels == std::vector<std::string>{"variance.R", "variance.G", "variance.B"}) return &layer;
  }
  return nullptr;
}

LoadedEyes load_eyes(const std::string& path, std::optional<Layout> layout) {
  OpenOptions options;
  options.form.layout = layout;
  const StoredPicture picture = open_picture(path, options);
  LoadedEyes loaded;
  loaded.guess.because = picture.layout_because;
  if (picture.eyes.size() == 2) loaded.guess.layout = picture.layout;
  loaded.projection = projection_name(picture.rig.projection);
  loaded.is_float = picture.is_float;
  for (const StoredEye& eye : picture.eyes) {
    loaded.eyes.push_back(linear_image(eye.layers[0], picture.size, picture.is_float));
    const LayerPixels* variance = find_variance(eye);
    if (variance) loaded.variance.push_back(linear_image(*variance, picture.size, true));
  }
  return loaded;
}

}  // namespace ods
