// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Every form of picture, ours and others', opened pixel by pixel; and saved by rows.
#include "ods/image/stored_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/base/error.h"
#include "ods/base/scratch.h"
#include "ods/image/save.h"
#include "ods/image/tone.h"
#include "tests/temporary_folder.h"

namespace ods {
namespace {

const int kWidth = 32, kHeight = 16;

float light(int eye, int x, int y, int c) {
  const float side = eye == kLeft ? 0.15f : eye == kRight ? 0.45f : 0.3f;
  return side + 0.006f * static_cast<float>(x) + 0.004f * static_cast<float>(y) + 0.01f * static_cast<float>(c);
}

// Colour (with alpha: 1 but in the first column), depth, normals.
PictureRows picture_rows(const std::vector<int>& eyes, bool alpha, bool layers) {
  PictureRows rows;
  rows.eye = {kWidth, kHeight};
  rows.eyes = eyes;
  rows.layers = {{{"R", "G", "B"}, LayerRule::kLight, Sample::kHalf}};
  if (alpha) rows.layers[0].channels.push_back("A");
  if (layers) {
    rows.layers.push_back({{"Z"}, LayerRule::kNearest, Sample::kFloat});
    rows.layers.push_back({{"N.X", "N.Y", "N.Z"}, LayerRule::kMean, Sample::kHalf});
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

float value_at(const LayerPixels& layer, int x, int y, size_t c) {
  return sample_value(layer.sample,
                      layer.first + x * layer.pixel_stride + y * layer.row_stride + c * bytes_of(layer.sample));
}

float light_at(const StoredPicture& picture, const StoredEye& eye, int x, int y, size_t c) {
  const float value = value_at(eye.layers[0], x, y, c);
  return picture.is_float ? value : srgb_decode(value);
}

SaveOptions options_for(Layout layout) {
  SaveOptions options;
  options.layout = layout;
  options.tone = ToneCurve::kLinear;
  return options;
}

OpenOptions as(std::optional<Layout> layout) {
  OpenOptions options;
  options.form.layout = layout;
  return options;
}

// Linear light that codecs may be off.
float tolerance(FileFormat format) {
  switch (format) {
    case FileFormat::kPng:
    case FileFormat::kTiff:
    case FileFormat::kHdr:
      return 0.004f;
    case FileFormat::kJpeg:
      return 0.02f;
    case FileFormat::kWebp:
      return 0.06f;
    case FileFormat::kExr:
      return 0.0005f;
  }
  return 0.0f;
}

void expect_eye(const StoredPicture& picture, const StoredEye& eye, FileFormat format) {
  const int columns = kWidth / picture.size.width, rows = kHeight / picture.size.height;
  const int border = tolerance(format) > 0.01f ? 1 : 0;  // over which lossy codecs mix the eyes
  for (int y = border; y < picture.size.height - border; y++) {
    for (int x = border; x < picture.size.width - border; x++) {
      for (int c = 0; c < 3; c++) {
        float mean = 0.0f;
        for (int i = 0; i < columns * rows; i++) {
          mean +=
              light(eye.eye, x * columns + i % columns, y * rows + i / columns, c) / static_cast<float>(columns * rows);
        }
        ASSERT_NEAR(light_at(picture, eye, x, y, static_cast<size_t>(c)), mean, tolerance(format)) << x << " " << y;
      }
    }
  }
}

TEST(OpenPicture, GivesBackTheEyesOfEveryLayoutAndFormat) {
  for (const char* extension : {"png", "jpg", "tif", "webp", "hdr", "exr"}) {
    for (Layout layout : kLayouts) {
      const FileFormat format = *format_of_path(std::string("a.") + extension);
      const bool lossy = format == FileFormat::kJpeg || format == FileFormat::kWebp;
      if (layout == Layout::kMultiview && format != FileFormat::kExr) continue;
      if (is_anaglyph(layout) || (layout == Layout::kRowInterleaved && lossy)) continue;
      SCOPED_TRACE(std::string(extension) + " " + std::string(layout_name(layout)));
      const TemporaryFolder folder;
      const std::string path = folder.path(std::string(layout == Layout::kSeparate ? "%V." : "a.") + extension);
      save_picture(picture_rows({kLeft, kRight}, false, true), nullptr, options_for(layout), path);
      const StoredPicture picture = open_picture(path, as(layout));
      ASSERT_EQ(picture.eyes.size(), 2u);
      EXPECT_EQ(picture.layout, layout);
      EXPECT_EQ(picture.is_float, is_scene_referred(format));
      EXPECT_EQ(picture.eyes[0].eye, kLeft);
      EXPECT_EQ(picture.eyes[1].eye, kRight);
      for (const StoredEye& eye : picture.eyes) expect_eye(picture, eye, format);
    }
  }
}

}  // namespace
}  // namespace ods
