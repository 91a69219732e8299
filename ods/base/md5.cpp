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

static uint32_t little(std::string_view bytes, size_t at) {
  uint32_t word = 0;
  for (size_t i = 4; i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
  return word;
}

// RFC 1321, 3.4. Its table is the fractions of sines.
static void add_block(Words& state, std::string_view block) {
  static const std::array<uint32_t, 64> kSines = [] {
    std::array<uint32_t, 64> sines{};
    for (size_t i = 0; i < 64; i++) {
      sines[i] = static_cast<uint32_t>(std::abs(std::sin(static_cast<double>(i + 1))) * 4294967296.0);
    }
    return sines;
  }();
  constexpr int kShifts[4][4] = {{7, 12, 17, 22}, {5, 9, 14, 20}, {4, 11, 16, 23}, {6, 10, 15, 21}};
  auto [a, b, c, d] = state;
  for (size_t i = 0; i < 64; i++) {
    const size_t round = i / 16;
    const uint32_t mixed[] = {(b & c) | (~b & d), (d & b) | (~d & c), b ^ c ^ d, c ^ (b | ~d)};
    const size_t words[] = {i, 5 * i + 1, 3 * i + 5, 7 * i};
    const uint32_t sum = a + mixed[round] + kSines[i] + little(block, words[round] % 16 * 4);
    a = d, d = c, c = b;
    b += std::rotl(sum, kShifts[round][i % 4]);
  }
  state = {state[0] + a, state[1] + b, state[2] + c, state[3] + d};
}

std::string md5(std::string_view bytes) {
  const size_t whole = bytes.size() / 64 * 64;
  std::string end(bytes.substr(whole));
  end += '\x80';
  end.resize((end.size() + 8 + 63) / 64 * 64 - 8);
  for (int bit = 0; bit < 64; bit += 8) end += static_cast<char>(uint64_t{bytes.size()} * 8 >> bit & 0xff);
  Words state = {0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476};
  for (size_t at = 0; at < whole; at += 64) add_block(state, bytes.substr(at, 64));
  for (size_t at = 0; at < end.size(); at += 64) add_block(state, std::string_view(end).substr(at, 64));
  std::string text;
  for (uint32_t word : state) {
    for (int shift = 0; shift < 32; shift += 8) text += fmt::format("{:02X}", word >> shift & 0xff);
  }
  return text;
}

}  // namespace ods
