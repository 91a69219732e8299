// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/comfort/heat.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "ods/base/median.h"
#include "ods/kernel/surface.h"

namespace ods {

namespace {

constexpr vec3 kColors[] = {{0, 0, 0}, {1.0f, 0.75f, 0.05f}, {1.0f, 0.22f, 0.0f}, {0.75f, 0.0f, 0.03f}};
constexpr float kHot = 0.7f;  // how much of a pixel's colour is its level's

float grey_of(const Image& light, size_t pixel) {
  const float* from = &light.pixels[3 * pixel];
  return luminance(vec3(from[0], from[1], from[2]));
}

// Makes the median of the picture a middle grey.
float exposure_of(const Image& light) {
  constexpr size_t kStep = 7;
  constexpr float kMiddle = 0.18f, kMax = 64.0f;
  std::vector<float> greys;
  for (size_t k = 0; k < light.pixels.size() / 3; k += kStep) {
    if (const float grey = grey_of(light, k); grey > 0.0f) greys.push_back(grey);
  }
  return greys.empty() ? 1.0f : std::min(kMiddle / median(std::move(greys)), kMax);
}

}  // namespace

Image heat_of(const Image& light, const Image& levels) {
  assert(light.pixels.size() == 3 * levels.pixels.size());
  const float exposure = exposure_of(light);
  Image heat(light.width, light.height, 3);
  for (size_t k = 0; k < levels.pixels.size(); k++) {
    const float grey = exposure * grey_of(light, k);
    const float shown = grey > 0.0f ? 0.6f * grey / (grey + 0.3f) : 0.0f;  // so that shade is not black
    const auto level = static_cast<size_t>(levels.pixels[k]);
    for (int c = 0; c < 3; c++) {
      const float hot = (1.0f - kHot) * shown + kHot * kColors[level][c];
      heat.pixels[3 * k + static_cast<size_t>(c)] = level == 0 ? shown : hot;
    }
  }
  return heat;
}

Picture heat_picture(const JudgedPicture& judged) {
  Picture picture;
  for (size_t i = 0; i < judged.light.size(); i++) {
    EyeImage& eye = picture.eyes.emplace_back();
    eye.eye = judged.verdict.per_eye[i].eye;
    eye.radiance = heat_of(judged.light[i], judged.verdict.per_eye[i].levels);
  }
  return picture;
}

}  // namespace ods
