// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Source: KTX 2.0, appendices "BasisLZ Global Data" and "BasisLZ/ETC1S Bitstream Specification"; the colours of a block
// are ETC1's, in the Khronos Data Format Specification. A block is two numbers: its four colours, and which of them
// each texel has.
#include <algorithm>
#include <utility>
#include <vector>

#include "ods/base/bytes.h"
#include "ods/image/codec/bit_reader.h"
#include "ods/image/codec/blocks.h"
#include "ods/image/codec/little_endian.h"

namespace ods {

namespace {

using Bytes = std::span<const std::byte>;
using FourColors = std::array<uint32_t, 4>;  // from the darkest
using Selectors = uint32_t;                  // two bits for each texel

struct Block {
  uint32_t colors = 0;
  uint32_t selectors = 0;
};

struct Codebook {
  std::vector<FourColors> colors;
  std::vector<Selectors> selectors;
  // Codes of slices.
  PrefixCode predictions, color_steps, selectors_used, runs;
  size_t history_size = 0;
};

[[noreturn]] void fail_damaged() {
  throw MalformedFile("its BasisLZ data is damaged");
}

// --- the codebook

FourColors colors_of(const std::array<uint32_t, 3>& base, uint32_t table) {
  constexpr int kSteps[8][2] = {{2, 8}, {5, 17}, {9, 29}, {13, 42}, {18, 60}, {24, 80}, {33, 106}, {47, 183}};
  const int steps[] = {-kSteps[table][1], -kSteps[table][0], kSteps[table][0], kSteps[table][1]};
  FourColors colors;
  for (size_t i = 0; i < 4; i++) {
    uint32_t c[3];
    for (size_t k = 0; k < 3; k++) {
      const int value = static_cast<int>(base[k] << 3 | base[k] >> 2);
      c[k] = static_cast<uint32_t>(std::clamp(value + steps[i], 0, 255));
    }
    colors[i] = pack_texel(c[0], c[1], c[2], 255);
  }
  return colors;
}

void read_colors(Bytes bytes, size_t count, Codebook& book) {
  BitReader bits(bytes);
  PrefixCode steps[3];  // after dark, middle and light colours
  for (PrefixCode& code : steps) code = read_prefix_code(bits);
  const PrefixCode table_steps = read_prefix_code(bits);
  const bool is_grey = bits.read(1) == 1;
  const auto next = [&](uint32_t value) {
    constexpr uint32_t kMiddle = 10, kLight = 22;
    const size_t range = value < kMiddle ? 0 : (value < kLight ? 1 : 2);
    return (value + steps[range].read(bits)) & 31;
  };
  std::array<uint32_t, 3> base = {16, 16, 16};
  uint32_t table = 0;
  for (size_t i = 0; i < count; i++) {
    table = (table + table_steps.read(bits)) & 7;
    base[0] = next(base[0]);
    base[1] = is_grey ? base[0] : next(base[1]);
    base[2] = is_grey ? base[0] : next(base[2]);
    book.colors.push_back(colors_of(base, table));
  }
}

void read_selectors(Bytes bytes, size_t count, Codebook& book) {
  BitReader bits(bytes);
  if (bits.read(2) != 0) fail_damaged();
  const bool is_plain = bits.read(1) == 1;
  const PrefixCode changes = is_plain ? PrefixCode() : read_prefix_code(bits);
  Selectors last = 0;
  for (size_t i = 0; i < count; i++) {
    Selectors selectors = 0;
    for (size_t row = 0; row < 4; row++) {
      selectors |= (is_plain || i == 0 ? bits.read(8) : changes.read(bits) & 255) << (8 * row);
    }
    last = is_plain ? selectors : last ^ selectors;
    book.selectors.push_back(last);
  }
}

void read_codes(Bytes bytes, Codebook& book) {
  BitReader bits(bytes);
  for (PrefixCode* code : {&book.predictions, &book.color_steps, &book.selectors_used, &book.runs}) {
    *code = read_prefix_code(bits);
  }
  book.history_size = bits.read(13);
}

// --- slices

// Recently used selectors, with frequent ones roughly in front.
class History {
 public:
  explicit History(size_t size) : values_(size), next_(size / 2) {}

  void add(uint32_t value) {
    if (values_.empty()) return;
    values_[next_++] = value;
    if (next_ == values_.size()) next_ = values_.size() / 2;
  }

  uint32_t use(size_t place) {
    if (place >= values_.size()) fail_damaged();
    std::swap(values_[place], values_[place / 2]);
    return values_[place / 2];
  }

 private:
  std::vector<uint32_t> values_;
  size_t next_;
};

class Slice {
 public:
  Slice(Bytes bytes, const Codebook& book, size_t width)
      : bits_(bytes), book_(book), history_(book.history_size), above_(width), predictions_((width + 1) / 2) {}

  // The next block of all blocks, row by row.
  Block next(size_t x, size_t y) {
    const uint32_t colors = next_colors(x, y);
    const uint32_t selectors = next_selectors();
    if (colors >= book_.colors.size() || selectors >= book_.selectors.size()) fail_damaged();
    return {colors, selectors};
  }

 private:
  // Reads a number in pieces of `size` bits; each piece after the first is announced by the bit above the previous one.
  uint32_t read_pieces(size_t size) {
    uint32_t value = 0;
    for (size_t shift = 0; shift < 32; shift += size) {
      const uint32_t piece = bits_.read(size + 1);
      value |= (piece & ((1u << size) - 1)) << shift;
      if (piece >> size == 0) return value;
    }
    fail_damaged();
  }

  // The predictors of the colours of four blocks, two bits for each.
  uint32_t read_predictions() {
    constexpr uint32_t kRepeat = 256, kMin = 3;
    if (repeated_predictions_ > 0) {
      repeated_predictions_--;
      return last_predictions_;
    }
    const uint32_t symbol = book_.predictions.read(bits_);
    if (symbol > kRepeat) fail_damaged();
    if (symbol == kRepeat) {
      repeated_predictions_ = uint64_t{read_pieces(4)} + kMin - 1;
    } else {
      last_predictions_ = symbol;
    }
    return last_predictions_;
  }

  uint32_t next_colors(size_t x, size_t y) {
    enum { kLeft, kAbove, kAboveLeft, kStep };
    if (x % 2 == 0 && y % 2 == 0) predictions_[x / 2] = read_predictions();
    const uint32_t prediction = predictions_[x / 2] >> (4 * (y % 2) + 2 * (x % 2)) & 3;
    const bool needs_left = prediction == kLeft || prediction == kAboveLeft;
    const bool needs_above = prediction == kAbove || prediction == kAboveLeft;
    if ((needs_left && x == 0) || (needs_above && y == 0)) fail_damaged();
    const uint32_t above = above_[x];
    if (prediction == kAbove) colors_ = above;
    if (prediction == kAboveLeft) colors_ = above_left_;
    if (prediction == kStep) {
      colors_ += book_.color_steps.read(bits_);
      if (colors_ >= book_.colors.size()) colors_ -= static_cast<uint32_t>(book_.colors.size());
    }
    above_left_ = above;
    above_[x] = colors_;
    return colors_;
  }

  uint32_t next_selectors() {
    constexpr uint32_t kLongRun = 63, kMin = 3;
    const auto count = static_cast<uint32_t>(book_.selectors.size());
    uint32_t symbol = count;  // the front of the history
    if (run_ > 0) {
      run_--;
    } else {
      symbol = book_.selectors_used.read(bits_);
      if (symbol == count + book_.history_size) {
        const uint32_t run = book_.runs.read(bits_);
        run_ = uint64_t{run == kLongRun ? read_pieces(7) : run} + kMin - 1;
        symbol = count;
      }
    }
    if (symbol >= count) return history_.use(symbol - count);
    history_.add(symbol);
    return symbol;
  }

  BitReader bits_;
  const Codebook& book_;
  History history_;
  uint64_t run_ = 0;
  std::vector<uint32_t> above_;  // the colours of the previous row, from here to the right
  uint32_t above_left_ = 0, colors_ = 0;
  std::vector<uint32_t> predictions_;  // for two rows
  uint32_t last_predictions_ = 0;
  uint64_t repeated_predictions_ = 0;
};

// The coded data of one picture.
struct Slices {
  Bytes color, alpha;  // alpha is empty if there is none
};

Slices slices_of(Bytes description, Bytes level) {
  constexpr uint32_t kDifference = 2;
  if (get_u32(description, 0) & kDifference) throw MalformedFile("it is a frame of a video, not a picture");
  return {part_of(level, get_u32(description, 4), get_u32(description, 8)),
          part_of(level, get_u32(description, 12), get_u32(description, 16))};
}

}  // namespace

void decode_basis_lz(Bytes global, size_t image_count, Bytes level, CodeImage& image) {
  constexpr size_t kHeader = 20, kDescription = 20;
  const size_t color_count = get_u16(global, 0), selector_count = get_u16(global, 2);
  const size_t sizes[] = {get_u32(global, 4), get_u32(global, 8), get_u32(global, 12)};
  const Slices slices = slices_of(part_of(global, kHeader, kDescription), level);
  Codebook book;
  size_t at = kHeader + kDescription * image_count;
  read_colors(part_of(global, at, sizes[0]), color_count, book);
  read_selectors(part_of(global, at += sizes[0], sizes[1]), selector_count, book);
  read_codes(part_of(global, at += sizes[1], sizes[2]), book);
  const size_t width = blocks_along(image.width), height = blocks_along(image.height);
  Slice color(slices.color, book, width), alpha(slices.alpha, book, width);
  for (size_t y = 0; y < height; y++) {
    for (size_t x = 0; x < width; x++) {
      const Block block = color.next(x, y), veil = slices.alpha.empty() ? Block() : alpha.next(x, y);
      TexelBlock texels;
      for (size_t i = 0; i < texels.size(); i++) {
        texels[i] = book.colors[block.colors][book.selectors[block.selectors] >> (2 * i) & 3];
        if (slices.alpha.empty()) continue;
        const uint32_t green = book.colors[veil.colors][book.selectors[veil.selectors] >> (2 * i) & 3] >> 8 & 255;
        texels[i] = (texels[i] & 0xffffff) | green << 24;
      }
      put_block(image, x, y, texels);
    }
  }
}

}  // namespace ods
