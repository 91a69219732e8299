// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/md5.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace ods {

using Words = std::array<uint32_t, 4>;

constexpr size_t kBlock = 64;  // bytes

static uint32_t word_at(std::string_view bytes, size_t at) {
  uint32_t word = 0;
  for (size_t i = 4; i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
  return word;
}

// floor(2^32 |sin(i + 1)|), which double precision holds exactly.
static std::array<uint32_t, kBlock> sines() {
  std::array<uint32_t, kBlock> table{};
  for (size_t i = 0; i < kBlock; i++) {
    table[i] = static_cast<uint32_t>(std::floor(4294967296.0 * std::abs(std::sin(static_cast<double>(i + 1)))));
  }
  return table;
}

static void add_block(Words& state, std::string_view block) {
  static constexpr int kTurns[4][4] = {{7, 12, 17, 22}, {5, 9, 14, 20}, {4, 11, 16, 23}, {6, 10, 15, 21}};
  static const std::array<uint32_t, kBlock> kSines = sines();
  auto [a, b, c, d] = state;
  for (size_t i = 0; i < kBlock; i++) {
    const size_t round = i / 16;
    uint32_t mixed = 0;
    size_t from = i;
    if (round == 0) {
      mixed = (b & c) | (~b & d);
    } else if (round == 1) {
      mixed = (d & b) | (~d & c), from = (5 * i + 1) % 16;
    } else if (round == 2) {
      mixed = b ^ c ^ d, from = (3 * i + 5) % 16;
    } else {
      mixed = c ^ (b | ~d), from = 7 * i % 16;
    }
    const uint32_t sum = a + mixed + kSines[i] + word_at(block, 4 * from);
    a = d, d = c, c = b;
    b += std::rotl(sum, kTurns[round][i % 4]);
  }
  state = {state[0] + a, state[1] + b, state[2] + c, state[3] + d};
}

std::string md5(std::string_view bytes) {
  Words state = {0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476};
  const size_t whole = bytes.size() / kBlock * kBlock;
  for (size_t at = 0; at < whole; at += kBlock) add_block(state, bytes.substr(at, kBlock));
  // A one, zeros up to 8 bytes before the end of a block, the number of bits.
  std::string end(bytes.substr(whole));
  end += '\x80';
  while (end.size() % kBlock != kBlock - 8) end += '\0';
  const uint64_t bits = uint64_t{bytes.size()} * 8;
  for (size_t i = 0; i < 8; i++) end += static_cast<char>(bits >> (8 * i) & 0xff);
  for (size_t at = 0; at < end.size(); at += kBlock) add_block(state, std::string_view(end).substr(at, kBlock));
  std::string text;
  for (const uint32_t word : state) {
    for (int shift = 0; shift < 32; shift += 8) text += fmt::format("{:02X}", word >> shift & 0xff);
  }
  return text;
}

}  // namespace ods
