// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

#include "ods/image/codec/decoder.h"

namespace ods {

namespace {

class WindowedDecoder final : public Decoder {
 public:
  WindowedDecoder(std::unique_ptr<Decoder> stored, int left, int top, int width, int height)
      : stored_(std::move(stored)), left_(left), top_(top) {
    info = stored_->info;
    info.width = width, info.height = height;
    whole_numbers = stored_->whole_numbers;
    rows_together = std::min(stored_->rows_together, height);
  }

  void read(int begin, int end, size_t first, size_t count, std::byte* to) override {
    const size_t pixel = bytes_of_pixel(first, count);
    const size_t row = pixel * size_of(info.width), stored_row = pixel * size_of(stored_->info.width);
    std::memset(to, 0, row * size_of(end - begin));
    const int from_y = std::max(begin, top_), until_y = std::min(end, sum(top_, stored_->info.height));
    const int from_x = std::max(0, left_), until_x = std::min(info.width, sum(left_, stored_->info.width));
    if (from_y >= until_y || from_x >= until_x) return;
    rows_.resize(stored_row * size_of(until_y - from_y));
    stored_->read(from_y - top_, until_y - top_, first, count, rows_.data());
    for (int y = from_y; y < until_y; y++) {
      std::memcpy(to + row * size_of(y - begin) + pixel * size_of(from_x),
                  &rows_[stored_row * size_of(y - from_y) + pixel * size_of(from_x - left_)],
                  pixel * size_of(until_x - from_x));
    }
    beyond_floats = stored_->beyond_floats;
  }

 private:
  static size_t size_of(int count) { return static_cast<size_t>(count); }
  static int sum(int begin, int count) {
    return static_cast<int>(std::min<int64_t>(int64_t{begin} + count, INT32_MAX));
  }

  std::unique_ptr<Decoder> stored_;
  int left_, top_;  // position of the stored part in the picture
  std::vector<std::byte> rows_;
};

}  // namespace

std::unique_ptr<Decoder> windowed(std::unique_ptr<Decoder> stored, int left, int top, int width, int height) {
  if (left == 0 && top == 0 && width == stored->info.width && height == stored->info.height) return stored;
  return std::make_unique<WindowedDecoder>(std::move(stored), left, top, width, height);
}

}  // namespace ods
