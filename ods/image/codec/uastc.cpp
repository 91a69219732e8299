// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Source: R. Geldreich, "UASTC LDR 4x4 Texture Specification" (the wiki of Basis Universal), which builds upon ASTC as
// in the Khronos Data Format Specification: quantised colours and weights, and the partition of a block. A block has
// one to three subsets, each with two colours that its texels mix.
#include <algorithm>

#include "ods/base/bytes.h"
#include "ods/image/codec/bit_reader.h"
#include "ods/image/codec/blocks.h"

namespace ods {

namespace {

// The quantisation of colours: a digit of this base, then bits. One without a digit has base 1.
// A value is digit * digit_step + (bits but the lowest) * factor >> shift, of 511, mirrored if the lowest bit is set:
// ASTC's table of bit patterns in numbers.
struct Quantizer {
  uint8_t base, bits;
  uint16_t digit_step, factor;
  uint8_t shift;
};
constexpr Quantizer k12{3, 2, 93, 278, 0}, k16{1, 4, 0, 0, 0}, k32{1, 5, 0, 0, 0}, k40{5, 3, 26, 261, 1},
    k48{3, 4, 22, 65, 0}, k160{5, 5, 6, 257, 3}, k192{3, 6, 5, 257, 4}, k256{1, 8, 0, 0, 0};

struct Mode {
  uint8_t code, code_bits;  // at the start of the block
  uint8_t hints;            // bits for transcoders to other formats
  uint8_t channels;         // 2 for grey and alpha
  uint8_t subsets, planes;  // with 2 planes, one channel has its own weights
  uint8_t weight_bits;
  Quantizer colors;
};

// Indexed by mode number. Mode 8 is a single colour.
constexpr Mode kModes[] = {
    {0x01, 4, 15, 3, 1, 1, 4, k192}, {0x35, 6, 15, 3, 1, 1, 2, k256}, {0x1d, 5, 15, 3, 2, 1, 3, k16},
    {0x03, 5, 15, 3, 3, 1, 2, k12},  {0x13, 5, 15, 3, 2, 1, 2, k40},  {0x0b, 5, 15, 3, 1, 1, 3, k256},
    {0x1b, 5, 15, 3, 1, 2, 2, k160}, {0x07, 5, 15, 3, 2, 1, 2, k40},  {0x17, 5, 0, 4, 0, 0, 0, k256},
    {0x0f, 5, 23, 4, 2, 1, 2, k16},  {0x02, 3, 17, 4, 1, 1, 4, k48},  {0x00, 2, 17, 4, 1, 2, 2, k48},
    {0x06, 3, 17, 4, 1, 1, 3, k192}, {0x1f, 5, 23, 4, 1, 2, 1, k256}, {0x0d, 5, 23, 4, 1, 1, 2, k256},
    {0x05, 7, 23, 2, 1, 1, 4, k256}, {0x15, 6, 23, 2, 2, 1, 2, k256}, {0x25, 6, 23, 2, 1, 2, 2, k256},
    {0x09, 4, 15, 3, 1, 1, 5, k32}};
constexpr size_t kThreeSubsets = 3, kOtherTwoSubsets = 7, kOneColor = 8, kGreyPlanes = 17;

// The texels in subset 1, from the lowest bit: ASTC's partitions of small blocks, for the seeds
//   28 20 16 29 91 9 107 72 149 204 50 114 496 17 78 39 252 828 43 156 116 210 476 273 684 359 246 195 694 524;
constexpr uint16_t kTwo[] = {0xcccc, 0x8888, 0x1111, 0xecc8, 0x377f, 0xfeec, 0x0137, 0x137f, 0xc800, 0x0013,
                             0xfe80, 0x17ff, 0x0017, 0x00ff, 0xfff0, 0x0fff, 0xff71, 0x8eff, 0x08ce, 0x008c,
                             0x7310, 0xceff, 0x7331, 0x088c, 0xceef, 0x6666, 0xf00f, 0x5555, 0x0f0f, 0x36c9};
// of mode 7, seeds 36 48 61 137 161 183 226 281 302 307 479 495 593 594 605 799 812 988 993;
constexpr uint16_t kOtherTwo[] = {0x00f0, 0x4444, 0x0133, 0xcc80, 0xf0ff, 0x2222, 0xffc8, 0xccce, 0x3c03, 0x00ee,
                                  0x7700, 0x3003, 0x00ce, 0xff80, 0x6fff, 0x1333, 0x11ff, 0x136c, 0x00ef};
// two bits for each texel, its subset: seeds 260 74 32 156 183 15 745 0 335 902 254.
constexpr uint32_t kThree[] = {0xa5a50000, 0xaa005555, 0xaa000055, 0x0000aa55, 0x25252525, 0x94949494,
                               0x58585858, 0x56560202, 0x92929292, 0x55aa0055, 0xa05050a0};

[[noreturn]] void fail_damaged_uastc() {
  throw MalformedFile("its UASTC data is damaged");
}

size_t read_mode(std::span<const std::byte> block, BitReader& bits) {
  const auto start = static_cast<uint32_t>(block[0]);
  for (size_t i = 0; i < std::size(kModes); i++) {
    if ((start & ((1u << kModes[i].code_bits) - 1)) != kModes[i].code) continue;
    bits.read(kModes[i].code_bits);
    return i;
  }
  fail_damaged_uastc();
}

template <size_t kCount, class T>
T read_row(const T (&table)[kCount], size_t index_bits, BitReader& bits) {
  const size_t index = bits.read(index_bits);
  if (index >= kCount) fail_damaged_uastc();
  return table[index];
}

// The subset of each texel.
std::array<uint8_t, 16> read_subsets(size_t mode, BitReader& bits) {
  std::array<uint8_t, 16> subsets{};
  if (kModes[mode].subsets == 1) return subsets;
  const bool three = mode == kThreeSubsets;
  const uint32_t rows = three                      ? read_row(kThree, 4, bits)
                        : mode == kOtherTwoSubsets ? read_row(kOtherTwo, 5, bits)
                                                   : read_row(kTwo, 5, bits);
  for (size_t i = 0; i < subsets.size(); i++) {
    subsets[i] = static_cast<uint8_t>(three ? rows >> (2 * i) & 3 : rows >> i & 1);
  }
  return subsets;
}

// Extends the lowest `count` bits to eight by repetition.
uint32_t repeated(uint32_t bits, size_t count) {
  uint32_t value = bits << (8 - count);
  for (size_t filled = count; filled < 8; filled *= 2) value |= value >> filled;
  return value;
}

uint32_t color_of(const Quantizer& quantizer, uint32_t digit, uint32_t low) {
  if (quantizer.base == 1) return repeated(low, quantizer.bits);
  const uint32_t value = (digit * quantizer.digit_step + ((low >> 1) * quantizer.factor >> quantizer.shift)) >> 2;
  return low & 1 ? 255 - value : value;
}

// Up to 18 colour values: for each subset and each channel, the first colour's and the second's. All digits come first,
// five of base 3 in 8 bits or three of base 5 in 7; the last group has as many bits as it needs.
std::array<uint32_t, 18> read_colors(const Quantizer& quantizer, size_t count, BitReader& bits) {
  std::array<uint32_t, 18> digits{}, colors{};
  const size_t together = quantizer.base == 3 ? 5 : 3;
  for (size_t i = 0; i < count && quantizer.base > 1; i += together) {
    constexpr uint8_t kBits3[] = {0, 2, 4, 5, 7, 8}, kBits5[] = {0, 3, 5, 7};
    const size_t here = std::min(together, count - i);
    uint32_t number = bits.read(quantizer.base == 3 ? kBits3[here] : kBits5[here]);
    for (size_t k = i; k < i + here; k++, number /= quantizer.base) digits[k] = number % quantizer.base;
  }
  for (size_t i = 0; i < count; i++) colors[i] = color_of(quantizer, digits[i], bits.read(quantizer.bits));
  return colors;
}

// A weight out of 64: the bits repeated up to six, plus one in the upper half.
uint32_t weight_of(uint32_t bits, size_t count) {
  const uint32_t value = repeated(bits, count) >> 2;
  return value > 32 ? value + 1 : value;
}

// By texel and plane. The first weight of a subset is in the lower half, so its highest bit is not stored.
std::array<uint32_t, 32> read_weights(const Mode& mode, const std::array<uint8_t, 16>& subsets, BitReader& bits) {
  std::array<uint32_t, 32> weights{};
  uint32_t begun = 0;  // one bit for each subset
  for (size_t i = 0; i < 16; i++) {
    const bool is_first = (begun >> subsets[i] & 1) == 0;
    begun |= 1u << subsets[i];
    for (size_t plane = 0; plane < mode.planes; plane++) {
      const size_t count = mode.weight_bits;
      weights[2 * i + plane] = weight_of(bits.read(is_first ? count - 1 : count), count);
    }
  }
  return weights;
}

uint32_t mix(uint32_t from, uint32_t to, uint32_t weight) {
  return (257 * from * (64 - weight) + 257 * to * weight + 32) >> 14;
}

}  // namespace

TexelBlock decode_uastc(std::span<const std::byte> block) {
  BitReader bits(block);
  const size_t number = read_mode(block, bits);
  const Mode& mode = kModes[number];
  TexelBlock texels;
  if (number == kOneColor) {
    uint32_t c[4];
    for (uint32_t& value : c) value = bits.read(8);
    texels.fill(pack_texel(c[0], c[1], c[2], c[3]));
    return texels;
  }
  for (size_t left = mode.hints; left > 0; left -= std::min<size_t>(left, 16)) bits.read(std::min<size_t>(left, 16));
  const std::array<uint8_t, 16> subsets = read_subsets(number, bits);
  size_t own_weights = 4;  // the channel that has them
  if (mode.planes == 2) own_weights = number == kGreyPlanes ? 3 : bits.read(2);
  const size_t values = 2 * size_t{mode.channels};  // per subset
  const std::array<uint32_t, 18> colors = read_colors(mode.colors, values * mode.subsets, bits);
  const std::array<uint32_t, 32> weights = read_weights(mode, subsets, bits);
  for (size_t i = 0; i < texels.size(); i++) {
    uint32_t c[4] = {0, 0, 0, 255};
    for (size_t k = 0; k < 4; k++) {
      if (k == 3 && mode.channels == 3) continue;
      const size_t channel = mode.channels == 2 ? k / 3 : k;
      const uint32_t* const pair = &colors[subsets[i] * values + 2 * channel];
      c[k] = mix(pair[0], pair[1], weights[2 * i + (k == own_weights ? 1 : 0)]);
    }
    texels[i] = pack_texel(c[0], c[1], c[2], c[3]);
  }
  return texels;
}

}  // namespace ods
