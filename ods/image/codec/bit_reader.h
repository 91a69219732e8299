// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the bits of a stream, least significant bit first, and prefix codes.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ods {

class BitReader {
 public:
  explicit BitReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  // The next `count` bits as a number, up to 16. Throws MalformedFile if there are fewer.
  uint32_t read(size_t count);

 private:
  std::span<const std::byte> bytes_;
  size_t at_ = 0;  // in bits
};

// A canonical prefix code: RFC 1951, section 3.2.2, with codes of up to 16 bits.
class PrefixCode {
 public:
  PrefixCode() = default;  // a code without symbols

  // lengths: of each symbol's code, 0 for none. Throws MalformedFile if there are more codes than possible.
  explicit PrefixCode(const std::vector<uint8_t>& lengths);

  // Throws MalformedFile if the bits are not a code.
  uint32_t read(BitReader& bits) const;

 private:
  static constexpr size_t kLongest = 16;

  std::array<uint32_t, kLongest + 1> counts_{};  // number of codes of each length
  std::vector<uint16_t> symbols_;                // in the order of their codes
};

// Reads a code that is described in the stream: the lengths of its codes, in a prefix code. KTX 2.0, "Compressed
// Huffman Tables".
PrefixCode read_prefix_code(BitReader& bits);

}  // namespace ods
