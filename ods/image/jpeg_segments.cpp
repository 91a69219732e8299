// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/jpeg_segments.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

namespace ods {

namespace {

enum Marker : unsigned char { kTemporary = 0x01, kRestart0 = 0xD0, kRestart7 = 0xD7, kStart = 0xD8, kEnd = 0xD9 };

// Those that no length stands behind.
bool stands_alone(unsigned char marker) {
  return marker == kTemporary || (marker >= kRestart0 && marker <= kStart);
}

// Bytes of a file one after the other, read in blocks.
class Bytes {
 public:
  Bytes(size_t size, const ByteReader& read) : size_(size), read_(read) {}

  // False: behind the last one.
  bool next(unsigned char& byte) {
    if (at_ >= size_ || !fill()) return false;
    byte = block_[at_++ - start_];
    return true;
  }
  void skip(size_t count) { at_ += std::min(count, size_ - at_); }

  // To the next 0xFF.
  bool find_mark() {
    while (at_ < size_ && fill()) {
      const unsigned char* from = block_.data() + (at_ - start_);
      const size_t count = start_ + block_.size() - at_;
      const void* found = std::memchr(from, 0xFF, count);
      at_ += found ? static_cast<size_t>(static_cast<const unsigned char*>(found) - from) : count;
      if (found) return true;
    }
    return false;
  }

 private:
  bool fill() {
    if (at_ >= start_ && at_ < start_ + block_.size()) return true;
    start_ = at_;
    block_.resize(std::min(size_t{1} << 16, size_ - at_));
    return read_(start_, block_.data(), block_.size());
  }

  size_t size_;
  const ByteReader& read_;
  size_t at_ = 0;
  size_t start_ = 0;
  std::vector<unsigned char> block_;
};

}  // namespace

bool is_whole_jpeg(size_t file_size, const ByteReader& read) {
  Bytes bytes(file_size, read);
  // Between two markers lie headers of a length, or coded pixels, in which 0xFF has a 0 behind it.
  while (bytes.find_mark()) {
    unsigned char marker = 0xFF;
    while (marker == 0xFF) {
      if (!bytes.next(marker)) return false;
    }
    if (marker == kEnd) return true;
    if (marker == 0 || stands_alone(marker)) continue;
    unsigned char high = 0, low = 0;
    if (!bytes.next(high) || !bytes.next(low)) return false;
    const size_t length = size_t{high} << 8 | low;
    bytes.skip(length < 2 ? 0 : length - 2);
  }
  return false;
}

}  // namespace ods
