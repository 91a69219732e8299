// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/jpeg_segments.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "ods/base/bytes.h"
#include "ods/base/error.h"

namespace ods {

namespace {

enum Marker : unsigned char {
  kTemporary = 0x01,
  kRestart0 = 0xD0,
  kRestart7 = 0xD7,
  kStart = 0xD8,
  kEnd = 0xD9,
  kScan = 0xDA
};

// Markers without a length.
bool stands_alone(unsigned char marker) {
  return marker == kTemporary || (marker >= kRestart0 && marker <= kStart);
}

// Reads a file byte by byte, through a buffer.
class Bytes {
 public:
  Bytes(size_t size, const ByteReader& read) : size_(size), read_(read) {}

  // Returns false at the end.
  bool next(unsigned char& byte) {
    if (at_ >= size_ || !fill()) return false;
    byte = block_[at_++ - start_];
    return true;
  }
  void skip(size_t count) { at_ += std::min(count, size_ - at_); }

  // Skips to the next 0xFF.
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
  // Between markers there are headers with a length, or coded pixels, in which a 0 follows every 0xFF.
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

std::vector<JpegSegment> read_jpeg_headers(const FileInput& file) {
  constexpr size_t kMax = 1000000;
  const auto damaged = [&] {
    return Error(ErrorKind::kInput, fmt::format("cannot use '{}': the JPEG is cut short or damaged", file.path()));
  };
  const auto byte = [](const std::string& bytes, size_t at) { return static_cast<unsigned char>(bytes[at]); };
  std::vector<JpegSegment> segments;
  for (uint64_t at = 2; segments.size() < kMax;) {
    if (at + 4 > file.size()) throw damaged();
    const std::string start = file.read(at, 4);
    if (byte(start, 0) != 0xFF) throw damaged();
    const unsigned char marker = byte(start, 1);
    if (marker == 0xFF) {  // fill byte
      at++;
      continue;
    }
    if (marker == kScan) return segments;
    const uint64_t length = get_number(start, 2, 2);
    if (stands_alone(marker) || marker == kEnd || length < 2 || length > file.size() - at - 2) throw damaged();
    segments.push_back({marker, at, length + 2, file.read(at + 4, length - 2)});
    at += length + 2;
  }
  throw damaged();
}

std::string jpeg_segment(unsigned char marker, std::string_view data) {
  const size_t length = data.size() + 2;
  const std::string header{'\xff', static_cast<char>(marker), static_cast<char>(length >> 8),
                           static_cast<char>(length & 0xff)};
  return header + std::string(data);
}

const JpegSegment* find_packet(const std::vector<JpegSegment>& headers) {
  const auto found = std::find_if(headers.begin(), headers.end(),
                                  [](const JpegSegment& segment) { return segment.data.starts_with(kJpegXmp); });
  return found == headers.end() ? nullptr : &*found;
}

uint64_t place_of_packet(const std::vector<JpegSegment>& headers) {
  uint64_t at = 2;
  for (const JpegSegment& segment : headers) {
    const bool goes_before = segment.data.starts_with("JFIF") || segment.data.starts_with("Exif");
    if (goes_before && segment.offset == at) at += segment.size;
  }
  return at;
}

// SOF0 .. SOF15, a range that also contains the table markers DHT and DAC and the reserved marker JPG.
static bool is_frame(unsigned char marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

std::optional<Extent> jpeg_size(const std::vector<JpegSegment>& headers) {
  for (const JpegSegment& segment : headers) {
    if (!is_frame(segment.marker) || segment.data.size() < 6) continue;
    const auto number = [&](size_t at) { return static_cast<int>(get_number(segment.data, at, 2)); };
    return Extent{number(3), number(1)};
  }
  return std::nullopt;
}

}  // namespace ods
