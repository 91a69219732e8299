// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/sample_type.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <vector>

namespace ods {

template <typename T>
static T load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

size_t bytes_of(SampleType sample) {
  switch (sample) {
    case SampleType::kUint8:
      return 1;
    case SampleType::kUint16:
    case SampleType::kHalf:
      return 2;
    case SampleType::kFloat:
      break;
  }
  return 4;
}

float sample_value(SampleType sample, const std::byte* at) {
  switch (sample) {
    case SampleType::kUint8:
      return static_cast<float>(*at) / 255.0f;
    case SampleType::kUint16:
      return static_cast<float>(load<uint16_t>(at)) / 65535.0f;
    case SampleType::kHalf:
      return glm::unpackHalf1x16(load<uint16_t>(at));
    case SampleType::kFloat:
      break;
  }
  return load<float>(at);
}

template <typename T>
static void divide(std::span<std::byte> pixels, size_t channels, size_t alpha, float power) {
  const float maximum = static_cast<float>(std::numeric_limits<T>::max());
  const size_t size = channels * sizeof(T);
  for (size_t at = 0; at + size <= pixels.size(); at += size) {
    const float opacity = static_cast<float>(load<T>(&pixels[at + alpha * sizeof(T)])) / maximum;
    if (opacity == 0.0f || opacity == 1.0f) continue;
    const float scale = std::pow(opacity, -power);
    for (size_t c = 0; c < channels; c++) {
      std::byte* const place = &pixels[at + c * sizeof(T)];
      if (c == alpha) continue;
      const T value = static_cast<T>(std::min(maximum, static_cast<float>(load<T>(place)) * scale + 0.5f));
      std::memcpy(place, &value, sizeof value);
    }
  }
}

// Adding a power of two with as many more digits as the float has beyond a half's rounds the float to the half's
// precision; the increase in the power's bits is the number of half steps. Branch-free, so that compilers vectorize it.
static uint16_t nearest_half(float value) {
  const int32_t kMin = 127 - 14, kLargest = std::bit_cast<int32_t>(65504.0f);  // the exponent as floats store it
  const int32_t bits = std::bit_cast<int32_t>(value), magnitude = bits & 0x7fffffff;
  const int32_t size = magnitude > 0x7f800000 ? 0 : std::min(magnitude, kLargest);
  const int32_t exponent = std::max(size >> 23, kMin);
  const int32_t power = (exponent + 13) << 23;
  const int32_t steps = std::bit_cast<int32_t>(std::bit_cast<float>(size) + std::bit_cast<float>(power)) - power;
  return static_cast<uint16_t>(((exponent - kMin) << 10) + steps + (bits >> 16 & 0x8000));
}

void floats_to_halves(std::span<const float> from, uint16_t* to) {
  for (size_t i = 0; i < from.size(); i++) to[i] = nearest_half(from[i]);
}

template <typename T>
static void pack_integers(std::span<const float> pixels, std::byte* to) {
  const float maximum = static_cast<float>(std::numeric_limits<T>::max());
  for (const float value : pixels) {
    const T code = static_cast<T>(finite(value, 0.0f, 1.0f) * maximum + 0.5f);
    std::memcpy(to, &code, sizeof code);
    to += sizeof code;
  }
}

void pack_floats(std::span<const SampleType> channels, std::span<const float> pixels, std::byte* to) {
  // Files of integers have one type for all channels.
  if (channels[0] == SampleType::kUint8) return pack_integers<uint8_t>(pixels, to);
  if (channels[0] == SampleType::kUint16) return pack_integers<uint16_t>(pixels, to);
  const auto halves_in_pixel = std::count(channels.begin(), channels.end(), SampleType::kHalf);
  if (halves_in_pixel == 0) {
    std::memcpy(to, pixels.data(), pixels.size_bytes());
    return;
  }
  std::vector<uint16_t> halves(pixels.size());
  floats_to_halves(pixels, halves.data());
  if (halves_in_pixel == static_cast<ptrdiff_t>(channels.size())) {
    std::memcpy(to, halves.data(), halves.size() * sizeof(uint16_t));
    return;
  }
  for (size_t i = 0; i < pixels.size(); i++) {
    const bool half = channels[i % channels.size()] == SampleType::kHalf;
    const size_t size = half ? sizeof(uint16_t) : sizeof(float);
    std::memcpy(to, half ? static_cast<const void*>(&halves[i]) : &pixels[i], size);
    to += size;
  }
}

void divide_by_alpha(SampleType sample, std::span<std::byte> pixels, size_t channels, size_t alpha, float power) {
  assert(sample == SampleType::kUint8 || sample == SampleType::kUint16);
  sample == SampleType::kUint8 ? divide<uint8_t>(pixels, channels, alpha, power)
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
