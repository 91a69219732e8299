// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The numbers that pixels are made of, as files have them.
#pragma once
#include <cstddef>
#include <span>

namespace ods {

enum class Sample { kUint8, kUint16, kHalf, kFloat };
size_t bytes_of(Sample sample);

// 0..1 for integers, the number itself for floats. Any address will do.
float sample_value(Sample sample, const std::byte* at);

// A number between two others; NaN becomes 0.
float finite(float value, float lowest, float highest);

// Code values of `channels` a pixel, the colours multiplied by (alpha / largest)^power: undone, as far as rounding
// left anything. kUint8 or kUint16.
void divide_by_alpha(Sample sample, std::span<std::byte> pixels, size_t channels, size_t alpha, float power);

// Numbers of 32 bits, a stride apart, become the floats that are equal to them. The first that no float equals, above
// 2^24, ends it and is returned; 0: none is.
unsigned whole_numbers_to_floats(std::span<std::byte> numbers, size_t stride);

}  // namespace ods
