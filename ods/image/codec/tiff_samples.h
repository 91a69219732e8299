// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Interprets the numbers of a TIFF, and converts rows of them to the format of Decoder::read(). Source: Adobe, "TIFF
// Revision 6.0", and its supplements on floats.
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
  int bits = 8;       // per number
  TiffNumber number = TiffNumber::kUnsigned;
  bool is_separate = false;                     // each number in its own plane
  bool zero_is_white = false;                   // for integers, of the first channel
  bool is_ink = false;                          // cyan, magenta, yellow and black become three colours
  std::vector<std::array<uint8_t, 3>> palette;  // if the number is an index; empty if there is none
  std::vector<std::string> channels;            // channels of the result
  SampleType sample = SampleType::kUint8;       // type of each channel
  std::optional<size_t> alpha;                  // index of the channel
  bool is_associated = false;                   // the file's colours are premultiplied

  bool is_float() const { return sample == SampleType::kHalf || sample == SampleType::kFloat; }
  // Returns whether a channel needs more than the number at its own position.
  bool needs_whole_pixels() const;
};

// The sample type for numbers of this form: integers become 8 or 16 bits, doubles floats. Returns nullopt if they are
// not supported.
std::optional<SampleType> tiff_sample(TiffNumber number, int bits);

// Converts rows one after the other. Not thread-safe.
class TiffRows {
 public:
  // Converts channels [first, first + count).
  TiffRows(const TiffSamples& samples, size_t first, size_t count);

  // The planes that convert() needs: [first, first + count). A single one if they are not separate.
  size_t first_plane() const { return first_plane_; }
  size_t planes() const { return planes_; }

  // Converts `width` pixels of a row: its bytes in each plane, as returned by libtiff.
  void convert(std::span<const std::byte* const> planes, size_t width, std::byte* to);

 private:
  const TiffSamples& samples_;
  size_t first_, count_;
  size_t first_plane_ = 0, planes_ = 1;
  std::vector<std::byte> numbers_, colors_;  // a row, before and after the conversion of whole pixels
};

}  // namespace ods
