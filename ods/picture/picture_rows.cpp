// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Saves a picture that is in memory: its layers become rows.
#include <algorithm>

#include "ods/picture/save.h"

namespace ods {

namespace {

struct ImageLayer {
  const Image EyeImage::*image;
  RowLayer layer;
};

}  // namespace

static const std::vector<ImageLayer>& image_layers() {
  static const std::vector<ImageLayer> layers = {
      {&EyeImage::radiance, {{"R", "G", "B"}, LayerRule::kLight, SampleType::kHalf}},
      {&EyeImage::depth, {{"Z"}, LayerRule::kNearest, SampleType::kFloat}},
      {&EyeImage::normal, {{"N.X", "N.Y", "N.Z"}, LayerRule::kMean, SampleType::kHalf}},
      {&EyeImage::albedo, {{"albedo.R", "albedo.G", "albedo.B"}, LayerRule::kMean, SampleType::kHalf}},
      {&EyeImage::variance, {{"variance.R", "variance.G", "variance.B"}, LayerRule::kNearest, SampleType::kFloat}},
      {&EyeImage::raw, {{"raw.R", "raw.G", "raw.B"}, LayerRule::kMean, SampleType::kHalf}},
      {&EyeImage::samples, {{"samples"}, LayerRule::kNearest, SampleType::kFloat}},
  };
  return layers;
}

PictureRows rows_of(const Picture& picture, bool all_layers) {
  PictureRows rows;
  rows.eye = {picture.eyes[0].radiance.width, picture.eyes[0].radiance.height};
  std::vector<const Image EyeImage::*> images;
  for (const ImageLayer& each : image_layers()) {
    if ((picture.eyes[0].*each.image).pixels.empty() || !(all_layers || images.empty())) continue;
    images.push_back(each.image);
    rows.layers.push_back(each.layer);
    if (images.size() > 1 || picture.eyes[0].alpha.pixels.empty()) continue;
    images.push_back(&EyeImage::alpha);  // is the fourth channel of the colour
    rows.layers[0].channels.push_back("A");
  }
  for (const EyeImage& eye : picture.eyes) rows.eyes.push_back(eye.eye);
  rows.fill = [&picture, images, stride = count_channels(rows.layers)](int index, int y, std::span<float> row) {
    float* out = row.data();
    for (const Image EyeImage::*image : images) {
      const Image& from = picture.eyes[static_cast<size_t>(index)].*image;
      const float* in = from.at(0, y);
      for (int x = 0; x < from.width; x++, in += from.channels) {
        std::copy(in, in + from.channels, out + static_cast<size_t>(x) * stride);
      }
      out += from.channels;
    }
  };
  return rows;
}

std::vector<std::string> save_picture(const Picture& picture, const StereoCamera& camera, const SaveOptions& options,
                                      const std::string& path) {
  return save_picture(rows_of(picture, keeps_layers(path)), &camera, options, path);
}

std::vector<std::string> save_picture(const Picture& picture, const SaveOptions& options, const std::string& path) {
  return save_picture(rows_of(picture, keeps_layers(path)), nullptr, options, path);
}

}  // namespace ods
