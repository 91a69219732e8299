// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/comfort/heat.h"

#include <algorithm>
#include <utility>

#include "cli/console/console.h"
#include "ods/base/median.h"
#include "ods/image/image_file.h"
#include "ods/image/tone.h"
#include "ods/kernel/surface.h"
#include "ods/picture/save.h"

static constexpr ods::vec3 kColors[] = {{0, 0, 0}, {1.0f, 0.75f, 0.05f}, {1.0f, 0.22f, 0.0f}, {0.75f, 0.0f, 0.03f}};
static constexpr float kHot = 0.7f;  // how much of a pixel's colour is its level's

static float grey_of(const ods::Image& light, size_t pixel) {
  const float* from = &light.pixels[3 * pixel];
  return ods::luminance(ods::vec3(from[0], from[1], from[2]));
}

// What makes half of the picture darker than a middle grey, and half lighter.
static float exposure_of(const ods::Image& light) {
  constexpr size_t kStep = 7;
  constexpr float kMiddle = 0.18f, kMost = 64.0f;
  std::vector<float> greys;
  for (size_t k = 0; k < light.pixels.size() / 3; k += kStep) {
    if (const float grey = grey_of(light, k); grey > 0.0f) greys.push_back(grey);
  }
  return greys.empty() ? 1.0f : std::min(kMiddle / ods::median(std::move(greys)), kMost);
}

ods::Image heat_of(const Judged& judged, const ods::ComfortReport& report) {
  const float exposure = exposure_of(judged.light);
  ods::Image heat(judged.light.width, judged.light.height, 3);
  for (size_t k = 0; k < report.level.pixels.size(); k++) {
    const float grey = exposure * grey_of(judged.light, k);
    const float light = grey > 0.0f ? 0.6f * grey / (grey + 0.3f) : 0.0f;  // so that shade is not black
    const auto color = static_cast<size_t>(report.level.pixels[k]);
    for (int c = 0; c < 3; c++) {
      const float hot = (1.0f - kHot) * light + kHot * kColors[color][c];
      heat.pixels[3 * k + static_cast<size_t>(c)] = color == 0 ? light : hot;
    }
  }
  return heat;
}

ods::Picture heat_picture(const Looked& looked, const std::vector<ods::ComfortReport>& reports) {
  ods::Picture picture;
  for (size_t i = 0; i < looked.eyes.size(); i++) {
    ods::EyeImage& eye = picture.eyes.emplace_back();
    eye.eye = looked.eyes[i].seen.eye;
    eye.radiance = heat_of(looked.eyes[i], reports[i]);
  }
  return picture;
}

void save_heat(const std::string& path, const Looked& looked, const std::vector<ods::ComfortReport>& reports) {
  for (const std::string& file : ods::save_picture(heat_picture(looked, reports), looked.camera, {}, path)) {
    announce_file(file);
  }
}

std::string heat_png(const Judged& judged, const ods::ComfortReport& report) {
  const ods::Image heat = heat_of(judged, report);
  ods::FileHeader header;
  header.width = heat.width, header.height = heat.height;
  header.channels = {{"R"}, {"G"}, {"B"}};
  return ods::image_bytes("the heat map", header, [&](int y, std::span<float> row) {
    std::transform(heat.at(0, y), heat.at(0, y) + row.size(), row.data(), ods::srgb_encode);
  });
}
