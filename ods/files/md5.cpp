// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/md5.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>

#include "ods/base/error.h"
#include "ods/files/read_file.h"

namespace ods {

namespace {

constexpr size_t kBlock = 64;  // bytes

uint32_t little_endian(std::string_view bytes, size_t at) {
  uint32_t word = 0;
  for (size_t i = 4; i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
  return word;
}

// RFC 1321, 3.4: a table of fractions of sines.
std::array<uint32_t, 64> make_sines() {
  std::array<uint32_t, 64> sines{};
  for (size_t i = 0; i < sines.size(); i++) {
    sines[i] = static_cast<uint32_t>(std::abs(std::sin(static_cast<double>(i + 1))) * 4294967296.0);
  }
  return sines;
}

class Md5 {
 public:
  // Whole blocks.
  void add(std::string_view bytes) {
    for (size_t at = 0; at < bytes.size(); at += kBlock) add_block(bytes.substr(at, kBlock));
    size_ += bytes.size();
  }

  // The last bytes, less than a block. Returns the digits.
  std::string finish(std::string_view bytes) {
    const uint64_t bits = (size_ + bytes.size()) * 8;
    std::string end(bytes);
    end += '\x80';
    end.resize((end.size() + 8 + kBlock - 1) / kBlock * kBlock - 8);
    for (int bit = 0; bit < 64; bit += 8) end += static_cast<char>(bits >> bit & 0xff);
    add(end);
    std::string text;
    for (const uint32_t word : state_) {
      for (int shift = 0; shift < 32; shift += 8) text += fmt::format("{:02X}", word >> shift & 0xff);
    }
    return text;
  }

 private:
  void add_block(std::string_view block) {
    static const std::array<uint32_t, 64> kSines = make_sines();
    constexpr int kShifts[4][4] = {{7, 12, 17, 22}, {5, 9, 14, 20}, {4, 11, 16, 23}, {6, 10, 15, 21}};
    auto [a, b, c, d] = state_;
    for (size_t i = 0; i < 64; i++) {
      const size_t round = i / 16;
      const uint32_t mixed[] = {(b & c) | (~b & d), (d & b) | (~d & c), b ^ c ^ d, c ^ (b | ~d)};
      const size_t words[] = {i, 5 * i + 1, 3 * i + 5, 7 * i};
      const uint32_t sum = a + mixed[round] + kSines[i] + little_endian(block, words[round] % 16 * 4);
      a = d, d = c, c = b;
      b += std::rotl(sum, kShifts[round][i % 4]);
    }
    state_ = {state_[0] + a, state_[1] + b, state_[2] + c, state_[3] + d};
  }

  std::array<uint32_t, 4> state_ = {0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476};
  uint64_t size_ = 0;  // bytes added
};

}  // namespace

std::string md5(std::string_view bytes) {
  const size_t whole = bytes.size() / kBlock * kBlock;
  Md5 sum;
  sum.add(bytes.substr(0, whole));
  return sum.finish(bytes.substr(whole));
}

std::string md5_of_file(const std::string& path) {
  size_t left = file_size(path);  // throws if it cannot be read
  std::ifstream stream(path, std::ios::binary);
  std::string part(size_t{1} << 20, '\0');
  Md5 sum;
  while (left >= part.size() && stream.read(part.data(), static_cast<std::streamsize>(part.size()))) {
    sum.add(part);
    left -= part.size();
  }
  if (!stream.read(part.data(), static_cast<std::streamsize>(left))) {
    throw Error(ErrorKind::kInput, fmt::format("cannot read '{}': reading stopped halfway", path));
  }
  const size_t whole = left / kBlock * kBlock;
  sum.add(std::string_view(part).substr(0, whole));
  return sum.finish(std::string_view(part).substr(whole, left - whole));
}

}  // namespace ods
