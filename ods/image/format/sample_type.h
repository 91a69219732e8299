// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The number types of pixels in files.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace ods {

enum class SampleType { kUint8, kUint16, kHalf, kFloat };
size_t bytes_of(SampleType sample);

// The value: 0..1 for integers, the number itself for floats. `at` need not be aligned.
float sample_value(SampleType sample, const std::byte* at);

// Clamps a number; NaN becomes 0.
inline float finite(float value, float lowest, float highest) {
  return std::isnan(value) ? 0.0f : std::clamp(value, lowest, highest);
}

// Rounds each float to the nearest half, ties to even (IEEE 754). NaN becomes 0; values beyond the largest half are
// clamped to it.
void floats_to_halves(std::span<const float> from, uint16_t* to);

// Packs interleaved pixels into the types of their channels. For integers 0..1 is the code range; NaN becomes 0.
void pack_floats(std::span<const SampleType> channels, std::span<const float> pixels, std::byte* to);

// Undoes, up to rounding, a multiplication of the colours by (alpha / largest)^power. `channels` samples per pixel,
// kUint8 or kUint16.
void divide_by_alpha(SampleType sample, std::span<std::byte> pixels, size_t channels, size_t alpha, float power);

// Converts 32-bit unsigned integers, `stride` bytes apart, to equal floats in place. Stops at the first one above 2^24
// that no float equals, and returns it; 0 if there is none.
unsigned whole_numbers_to_floats(std::span<std::byte> numbers, size_t stride);

}  // namespace ods
