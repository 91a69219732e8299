// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// From what a display shows to the numbers of a video: Y'CbCr with the matrix of BT.709, of limited range (black is 16,
// white 235 of 8 bits), rounded to the nearest. Source: ITU-R BT.709-6, 3.2 to 4.6. And the way back, of other videos
// too. Source of their matrix: ITU-R BT.601-7, 2.5.
#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string_view>

#include "ods/base/names.h"
#include "ods/camera/layout.h"

namespace ods {

// How many pixels share a colour: a block of 2x2, two beside each other, none. A shared colour lies on the left pixels,
// half way between the rows: it is the mean of both rows and, 1 2 1, of the pixel's neighbours.
enum class Chroma { k420, k422, k444 };
inline constexpr NameRow<Chroma> kChromaTable[] = {
    {Chroma::k420, "420"},
    {Chroma::k422, "422"},
    {Chroma::k444, "444"},
};
static_assert(has_every_member(kChromaTable));
inline constexpr auto kChromas = members_of(kChromaTable);
constexpr std::string_view chroma_name(Chroma chroma) {
  return name_in(kChromaTable, chroma);
}
Extent chroma_block(Chroma chroma);  // 2x2, 2x1, 1x1

// Y, Cb and Cr of a frame or a part of it, rows `stride` bytes apart. Bytes for 8 bits, words of 16 for more.
struct Planes {
  int bits = 8;
  Chroma chroma = Chroma::k420;
  std::array<std::byte*, 3> first{};
  std::array<size_t, 3> stride{};

  // Those that begin at a pixel. Precondition: it begins a block.
  Planes at(int x, int y) const;
};

// Fills `row` with the width's red, then green, then blue: 0..1 as a display takes them. Called by several threads at
// once.
using CodeRows = std::function<void(int y, std::span<float> row)>;

// An image into its planes; colours are shared within it alone. Precondition: `size` is of whole blocks.
void put_ycbcr(const CodeRows& rows, Extent size, const Planes& planes);

// What the numbers of a video mean.
struct ColorCode {
  bool is_601 = false;          // the matrix of BT.601, else that of BT.709
  bool has_full_range = false;  // black is 0, white the largest number
  bool operator==(const ColorCode&) const = default;
};

// The pixels from column `first` on of row y of an image: as many as `row` has room for, as CodeRows has them; values
// may lie outside of 0..1. Shared colours, which lie as Chroma says, are interpolated linearly within the image.
void get_codes(const Planes& planes, Extent size, const ColorCode& color, int y, int first, std::span<float> row);

}  // namespace ods
