// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/codec/bit_reader.h"

#include <gtest/gtest.h>

#include <string>

#include "ods/base/bytes.h"

namespace ods {
namespace {

// Bits in the order in which they are read.
std::vector<std::byte> bytes_of(const std::string& bits) {
  std::vector<std::byte> bytes((bits.size() + 7) / 8);
  for (size_t i = 0; i < bits.size(); i++) {
    if (bits[i] == '1') bytes[i / 8] |= static_cast<std::byte>(1 << (i % 8));
  }
  return bytes;
}

// A number, the lowest bit first.
std::string number(uint32_t value, size_t count) {
  std::string bits;
  for (size_t i = 0; i < count; i++) bits += (value >> i & 1) ? '1' : '0';
  return bits;
}

TEST(BitReader, TheLowestBitsComeFirst) {
  const std::vector<std::byte> bytes = {std::byte{0x5a}, std::byte{0xc3}, std::byte{0x81}};
  BitReader bits(bytes);
  EXPECT_EQ(bits.read(4), 0xau);
  EXPECT_EQ(bits.read(0), 0u);
  EXPECT_EQ(bits.read(16), 0x1c35u);
  EXPECT_THROW(bits.read(5), MalformedFile);
  EXPECT_EQ(bits.read(4), 8u);
  EXPECT_THROW(bits.read(1), MalformedFile);
}

// The example of RFC 1951, 3.2.2.
TEST(PrefixCode, IsCanonical) {
  const PrefixCode code({3, 3, 3, 3, 3, 2, 4, 4});
  const std::vector<std::byte> bytes = bytes_of(
      "010"
      "011"
      "100"
      "101"
      "110"
      "00"
      "1110"
      "1111");
  BitReader bits(bytes);
  for (uint32_t symbol = 0; symbol < 8; symbol++) EXPECT_EQ(code.read(bits), symbol);
}

TEST(PrefixCode, NoMoreCodesThanThereAre) {
  EXPECT_THROW(PrefixCode({1, 1, 1}), MalformedFile);
  EXPECT_THROW(PrefixCode(std::vector<uint8_t>(3, 1)), MalformedFile);
  const std::vector<std::byte> ones = bytes_of(std::string(32, '1'));
  for (const PrefixCode& code : {PrefixCode(), PrefixCode({1}), PrefixCode(std::vector<uint8_t>(9, 0))}) {
    BitReader bits(ones);
    EXPECT_THROW(code.read(bits), MalformedFile);
  }
}

// A table whose lengths are written with lengths 0 and 2 (codes 0 and 10) and one kind of run (code 11).
std::string table(uint32_t run_symbol, uint32_t symbols) {
  constexpr uint32_t kOrder[] = {17, 18, 19, 20, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2};
  std::string bits = number(symbols, 14) + number(std::size(kOrder), 5);
  for (const uint32_t symbol : kOrder) {
    bits += number(symbol == 0 ? 1 : (symbol == 2 || symbol == run_symbol ? 2 : 0), 3);
  }
  return bits;
}

TEST(PrefixCode, RunsOfLengths) {
  // 11 gaps and a length; a length and its repetition; gaps by the short run.
  const std::string two = "10", run = "11";
  const std::string tables[] = {table(18, 12) + run + number(0, 7) + two, table(19, 4) + two + run + number(0, 2),
                                table(17, 11) + run + number(7, 3) + two};
  const uint32_t firsts[] = {11, 0, 10};
  for (size_t i = 0; i < std::size(tables); i++) {
    const std::vector<std::byte> bytes = bytes_of(tables[i] + "00");
    BitReader bits(bytes);
    EXPECT_EQ(read_prefix_code(bits).read(bits), firsts[i]) << i;
  }
}

TEST(PrefixCode, DamagedTables) {
  const std::string two = "10", run = "11";
  const std::string tables[] = {
      table(19, 4) + run + number(0, 2),              // repeats nothing
      table(20, 9) + "0" + run + number(0, 7),        // repeats a gap
      table(19, 3) + two + run + number(0, 2),        // one more than there are
      table(19, 9) + two + run + number(3, 2) + two,  // ends too early
      number(1, 14) + number(31, 5),                  // more lengths than exist
  };
  for (const std::string& each : tables) {
    const std::vector<std::byte> bytes = bytes_of(each);
    BitReader bits(bytes);
    EXPECT_THROW(read_prefix_code(bits), MalformedFile) << each;
  }
}

}  // namespace
}  // namespace ods
