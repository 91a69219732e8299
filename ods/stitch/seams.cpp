// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stitch/seams.h"

#include <cmath>

namespace ods {

// Display-encoded brightness, which is approximately perceptually uniform.
static std::vector<float> brightness_of(const std::vector<float>& row, size_t channels) {
  std::vector<float> brightness(row.size() / channels);
  for (size_t x = 0; x < brightness.size(); x++) {
    const float* pixel = &row[x * channels];
    const float light = 0.2126f * pixel[0] + 0.7152f * pixel[1] + 0.0722f * pixel[2];
    brightness[x] = std::sqrt(std::max(light, 0.0f));
  }
  return brightness;
}

// Marks the columns on either side of each border.
static std::vector<char> border_columns(const SlitRig& rig) {
  std::vector<char> borders(static_cast<size_t>(rig.eye.width));
  const auto slit_of = [&](int x) { return static_cast<int>((x + 0.5) * rig.options.slits / rig.eye.width); };
  for (int x = 1; x < rig.eye.width; x++) {
    if (slit_of(x) != slit_of(x - 1)) borders[static_cast<size_t>(x)] = borders[static_cast<size_t>(x) - 1] = 1;
  }
  return borders;
}

SeamReport measure_seams(const SlitRig& rig, const PictureRows& rows) {
  const size_t channels = count_channels(rows.layers);
  const std::vector<char> borders = border_columns(rig);
  std::vector<float> row(static_cast<size_t>(rig.eye.width) * channels);
  double sum[2] = {0.0, 0.0}, count[2] = {0.0, 0.0};
  SeamReport report;
  for (size_t eye = 0; eye < rows.eyes.size(); eye++) {
    EyeImage image;
    image.eye = rows.eyes[eye];
    image.radiance = Image(rig.eye.width, rig.eye.height, 3);
    for (int y = 0; y < rig.eye.height; y++) {
      rows.fill(static_cast<int>(eye), y, row);
      const std::vector<float> light = brightness_of(row, channels);
      for (size_t x = 1; x + 1 < light.size(); x++) {
        const float bend = std::abs(light[x - 1] - 2.0f * light[x] + light[x + 1]);
        const bool border = borders[x] != 0;
        sum[border] += static_cast<double>(bend), count[border]++;
        float* out = image.radiance.at(static_cast<int>(x), y);
        out[0] = 8.0f * bend + (border ? 0.1f : 0.0f), out[1] = out[2] = 8.0f * bend;
      }
    }
    report.picture.eyes.push_back(std::move(image));
  }
  if (count[1] > 0.0 && sum[0] > 0.0) report.ratio = sum[1] / count[1] / (sum[0] / count[0]);
  return report;
}

}  // namespace ods
