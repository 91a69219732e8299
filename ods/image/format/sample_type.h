// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The numbers that pixels are made of, as files have them.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace ods {

enum class SampleType { kUint8, kUint16, kHalf, kFloat };
size_t bytes_of(SampleType sample);

// 0..1 for integers, the number itself for floats. Any address will do.
float sample_value(SampleType sample, const std::byte* at);

// A number between two others; NaN becomes 0.
inline float finite(float value, float lowest, float highest) {
  return std::isnan(value) ? 0.0f : std::clamp(value, lowest, highest);
}

// The nearest half of each float, of two as near the even one, as IEEE 754 has it. As finite(): NaN becomes 0, what is
// larger than the largest half becomes that.
void floats_to_halves(std::span<const float> from, uint16_t* to);

// Pixels of these channels, one behind the other: those that are kHalf become halves, the others stay floats.
void pack_floats(std::span<const SampleType> channels, std::span<const float> pixels, std::byte* to);

// Code values of `channels` a pixel, the colours multiplied by (alpha / largest)^power: undone, as far as rounding
// left anything. kUint8 or kUint16.
void divide_by_alpha(SampleType sample, std::span<std::byte> pixels, size_t channels, size_t alpha, float power);

// Numbers of 32 bits, a stride apart, become the floats that are equal to them. The first that no float equals, above
// 2^24, ends it and is returned; 0: none is.
unsigned whole_numbers_to_floats(std::span<std::byte> numbers, size_t stride);

}  // namespace ods
