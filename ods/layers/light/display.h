// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <utility>

#include "ods/image/image.h"
#include "ods/image/tone.h"

namespace ods {

// Converts scene-linear light, 3 channels, to displayed values, sRGB-encoded, 0..1. exposure: stops.
inline Image displayed(Image light, float exposure, ToneCurve tone) {
  for (size_t i = 0; i < light.pixels.size(); i += 3) {
    const vec3 shown = tone_map({light.pixels[i], light.pixels[i + 1], light.pixels[i + 2]}, exposure, tone);
    for (size_t c = 0; c < 3; c++) light.pixels[i + c] = srgb_encode(shown[static_cast<int>(c)]);
  }
  return light;
}

}  // namespace ods
