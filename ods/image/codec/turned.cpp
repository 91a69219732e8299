// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <utility>

#include "ods/image/codec/decoder.h"

namespace ods {

namespace {

// Keeps the whole picture in memory, because rows of the rotated one are columns of the stored one.
class TurnedDecoder final : public Decoder {
 public:
  TurnedDecoder(std::unique_ptr<Decoder> stored, int orientation)
      : stored_(std::move(stored)),
        orientation_(orientation),
        width_(stored_->info.width),
        height_(stored_->info.height) {
    info = stored_->info;
    whole_numbers = stored_->whole_numbers;
    if (orientation >= 5) std::swap(info.width, info.height);
  }

  void read(int begin, int end, size_t first, size_t count, std::byte* to) override {
    const size_t pixel = stored_->bytes_of_pixel(0, info.channels.size()), part = bytes_of_pixel(first, count);
    if (pixels_.empty()) {
      pixels_.resize(pixel * static_cast<size_t>(width_) * static_cast<size_t>(height_));
      stored_->read(0, height_, 0, info.channels.size(), pixels_.data());
    }
    const size_t skip = first == 0 ? 0 : bytes_of_pixel(0, first);
    for (int y = begin; y < end; y++) {
      for (int x = 0; x < info.width; x++, to += part) {
        const auto [from_x, from_y] = place_of(x, y);
        const size_t at = static_cast<size_t>(from_y) * static_cast<size_t>(width_) + static_cast<size_t>(from_x);
        std::memcpy(to, &pixels_[at * pixel + skip], part);
      }
    }
  }

 private:
  std::pair<int, int> place_of(int x, int y) const {
    const int right = width_ - 1, bottom = height_ - 1;
    switch (orientation_) {
      case 2:
        return {right - x, y};
      case 3:
        return {right - x, bottom - y};
      case 4:
        return {x, bottom - y};
      case 5:
        return {y, x};
      case 6:
        return {y, bottom - x};
      case 7:
        return {right - y, bottom - x};
      case 8:
        return {right - y, x};
      default:
        return {x, y};
    }
  }

  std::unique_ptr<Decoder> stored_;
  int orientation_;
  int width_, height_;  // as stored
  std::vector<std::byte> pixels_;
};

}  // namespace

std::unique_ptr<Decoder> turned(std::unique_ptr<Decoder> stored, int orientation) {
  if (orientation == 1) return stored;
  return std::make_unique<TurnedDecoder>(std::move(stored), orientation);
}

}  // namespace ods
