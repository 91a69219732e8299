// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/sample.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <limits>

namespace ods {

template <typename T>
static T load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

size_t bytes_of(Sample sample) {
  switch (sample) {
    case Sample::kUint8:
      return 1;
    case Sample::kUint16:
    case Sample::kHalf:
      return 2;
    case Sample::kFloat:
      break;
  }
  return 4;
}

float sample_value(Sample sample, const std::byte* at) {
  switch (sample) {
    case Sample::kUint8:
      return static_cast<float>(*at) / 255.0f;
    case Sample::kUint16:
      return static_cast<float>(load<uint16_t>(at)) / 65535.0f;
    case Sample::kHalf:
      return glm::unpackHalf1x16(load<uint16_t>(at));
    case Sample::kFloat:
      break;
  }
  return load<float>(at);
}

template <typename T>
static void divide(std::span<std::byte> pixels, size_t channels, size_t alpha, float power) {
  const float most = static_cast<float>(std::numeric_limits<T>::max());
  const size_t size = channels * sizeof(T);
  for (size_t at = 0; at + size <= pixels.size(); at += size) {
    const float opacity = static_cast<float>(load<T>(&pixels[at + alpha * sizeof(T)])) / most;
    if (opacity == 0.0f || opacity == 1.0f) continue;
    const float scale = std::pow(opacity, -power);
    for (size_t c = 0; c < channels; c++) {
      std::byte* const place = &pixels[at + c * sizeof(T)];
      if (c == alpha) continue;
      const T value = static_cast<T>(std::min(most, static_cast<float>(load<T>(place)) * scale + 0.5f));
      std::memcpy(place, &value, sizeof value);
    }
  }
}

float finite(float value, float lowest, float highest) {
  return std::isnan(value) ? 0.0f : std::clamp(value, lowest, highest);
}

void divide_by_alpha(Sample sample, std::span<std::byte> pixels, size_t channels, size_t alpha, float power) {
  assert(sample == Sample::kUint8 || sample == Sample::kUint16);
  sample == Sample::kUint8 ? divide<uint8_t>(pixels, channels, alpha, power)
                           : divide<uint16_t>(pixels, channels, alpha, power);
}

unsigned whole_numbers_to_floats(std::span<std::byte> numbers, size_t stride) {
  for (size_t at = 0; at + sizeof(float) <= numbers.size(); at += stride) {
    const uint32_t number = load<uint32_t>(&numbers[at]);
    if (number > 1u << 24) return number;
    const float same = static_cast<float>(number);
    std::memcpy(&numbers[at], &same, sizeof same);
  }
  return 0;
}

}  // namespace ods
