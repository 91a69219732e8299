// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/tone.h"

#include <cmath>
#include <limits>

namespace ods {

static vec3 neutral(vec3 color) {
  const float kFresnel = 0.04f;  // reflectance of a dielectric at normal incidence; keeps base colours unchanged
  const float kStart = 0.8f - kFresnel;
  const float kRoom = 1.0f - kStart;
  const float kDesaturation = 0.15f;
  const float low = min(color.x, min(color.y, color.z));
  color -= low < 2.0f * kFresnel ? low - low * low / (4.0f * kFresnel) : kFresnel;
  const float peak = max(color.x, max(color.y, color.z));
  if (peak < kStart) return color;
  const float rolled = 1.0f - kRoom * kRoom / (peak + kRoom - kStart);
  const float colorful = 1.0f / (kDesaturation * (peak - rolled) + 1.0f);
  return mix(vec3(rolled), color * (rolled / peak), colorful);
}

vec3 tone_map(vec3 light, float exposure, ToneCurve curve) {
  // Far above any light, but far enough from the largest float that the curve cannot overflow.
  const float kBrightest = 1e30f;
  const float scale = std::exp2(exposure);
  for (int i = 0; i < 3; i++) {
    const float value = light[i] * scale;
    light[i] = value > 0.0f ? min(value, kBrightest) : 0.0f;  // also for NaN
  }
  if (curve == ToneCurve::kNeutral) light = neutral(light);
  return clamp(light, 0.0f, 1.0f);
}

float srgb_encode(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float srgb_decode(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

std::vector<float> linear_from_encoded(int largest) {
  std::vector<float> light;
  for (int code = 0; code <= largest; code++) {
    light.push_back(srgb_decode(static_cast<float>(code) / static_cast<float>(largest)));
  }
  return light;
}

}  // namespace ods
