// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What the numbers of a TIFF mean, and rows of them as Decoder::read() returns them. Source: Adobe, "TIFF Revision
// 6.0", and its supplements on floats.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ods/image/format/sample_type.h"

namespace ods {

enum class TiffNumber { kUnsigned, kSigned, kFloat };

struct TiffSamples {
  size_t inputs = 1;  // numbers per pixel in the file
  int bits = 8;       // of each
  TiffNumber number = TiffNumber::kUnsigned;
  bool is_separate = false;                     // each of them in a plane of its own
  bool zero_is_white = false;                   // integers, of the first channel
  bool is_ink = false;                          // cyan, magenta, yellow and black become three colours
  std::vector<std::array<uint8_t, 3>> palette;  // of one number; empty: none
  std::vector<std::string> channels;            // that they become
  SampleType sample = SampleType::kUint8;       // of each channel
  std::optional<size_t> alpha;                  // a channel
  bool is_associated = false;                   // the file's colours are multiplied by it

  bool is_float() const { return sample == SampleType::kHalf || sample == SampleType::kFloat; }
  // Whether a channel needs more than the number in its own place.
  bool needs_whole_pixels() const;
};

// The type for numbers of this form: integers become 8 or 16 bits, doubles floats. Nothing: they cannot be read.
std::optional<SampleType> tiff_sample(TiffNumber number, int bits);

// Converts rows, one after the other. Not for several threads at once.
class TiffRows {
 public:
  // Channels [first, first + count).
  TiffRows(const TiffSamples& samples, size_t first, size_t count);

  // The planes that convert() needs: [first, first + count). One if they are not separate.
  size_t first_plane() const { return first_plane_; }
  size_t planes() const { return planes_; }

  // `width` pixels of a row: its bytes in each plane, as libtiff returns them.
  void convert(std::span<const std::byte* const> planes, size_t width, std::byte* to);

 private:
  const TiffSamples& samples_;
  size_t first_, count_;
  size_t first_plane_ = 0, planes_ = 1;
  std::vector<std::byte> numbers_, colors_;  // a row, before and after what needs whole pixels
};

}  // namespace ods
