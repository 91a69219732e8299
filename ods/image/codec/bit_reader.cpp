// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/codec/bit_reader.h"

#include <algorithm>

#include "ods/base/bytes.h"

namespace ods {

uint32_t BitReader::read(size_t count) {
  if (count > 8 * bytes_.size() - at_) throw MalformedFile("its data ends too early");
  uint32_t word = 0;  // the bits are in up to three bytes
  for (size_t i = 0; i < 3 && at_ / 8 + i < bytes_.size(); i++) {
    word |= static_cast<uint32_t>(bytes_[at_ / 8 + i]) << (8 * i);
  }
  word >>= at_ % 8;
  at_ += count;
  return word & ((1u << count) - 1);
}

PrefixCode::PrefixCode(const std::vector<uint8_t>& lengths) {
  for (const uint8_t length : lengths) counts_[length]++;
  counts_[0] = 0;
  uint32_t taken = 0;  // share of the 2^16 longest codes
  std::array<size_t, kLongest + 2> starts{};
  for (size_t length = 1; length <= kLongest; length++) {
    taken += counts_[length] << (kLongest - length);
    starts[length + 1] = starts[length] + counts_[length];
  }
  if (taken > 1u << kLongest) throw MalformedFile("a prefix code in it is damaged");
  symbols_.resize(starts[kLongest + 1]);
  for (size_t symbol = 0; symbol < lengths.size(); symbol++) {
    if (lengths[symbol] > 0) symbols_[starts[lengths[symbol]]++] = static_cast<uint16_t>(symbol);
  }
}

uint32_t PrefixCode::read(BitReader& bits) const {
  uint32_t code = 0, first = 0;  // codes of this length
  size_t shorter = 0;            // symbols with shorter codes
  for (size_t length = 1; length <= kLongest; length++) {
    code = code << 1 | bits.read(1);
    first <<= 1;
    if (code - first < counts_[length]) return symbols_[shorter + code - first];
    first += counts_[length];
    shorter += counts_[length];
  }
  throw MalformedFile("a prefix code in it is damaged");
}

PrefixCode read_prefix_code(BitReader& bits) {
  // Lengths up to 16 are literal; the others are runs.
  enum { kShortGap = 17, kLongGap, kShortRepeat, kLongRepeat, kLengthSymbols };
  constexpr std::array<uint8_t, kLengthSymbols> kOrder = {17, 18, 19, 20, 0,  8, 7,  9, 6,  10, 5,
                                                          11, 4,  12, 3,  13, 2, 14, 1, 15, 16};
  const size_t count = bits.read(14), length_count = bits.read(5);
  if (length_count > kOrder.size()) throw MalformedFile("a prefix code in it is damaged");
  std::vector<uint8_t> length_lengths(kLengthSymbols);
  for (size_t i = 0; i < length_count; i++) length_lengths[kOrder[i]] = static_cast<uint8_t>(bits.read(3));
  const PrefixCode length_code(length_lengths);
  std::vector<uint8_t> lengths;
  while (lengths.size() < count) {
    const uint32_t symbol = length_code.read(bits);
    const bool repeats = symbol == kShortRepeat || symbol == kLongRepeat;
    if (repeats && (lengths.empty() || lengths.back() == 0)) throw MalformedFile("a prefix code in it is damaged");
    size_t run = 1;
    if (symbol == kShortGap) run = 3 + bits.read(3);
    if (symbol == kLongGap) run = 11 + bits.read(7);
    if (symbol == kShortRepeat) run = 3 + bits.read(2);
    if (symbol == kLongRepeat) run = 7 + bits.read(7);
    uint8_t length = static_cast<uint8_t>(symbol);
    if (symbol >= kShortGap) length = repeats ? lengths.back() : 0;
    lengths.insert(lengths.end(), run, length);
  }
  if (lengths.size() != count) throw MalformedFile("a prefix code in it is damaged");
  return PrefixCode(lengths);
}

}  // namespace ods
