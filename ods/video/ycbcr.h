// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Converts display-encoded RGB to a video's limited-range BT.709 Y'CbCr (black 16, white 235 at 8 bits), rounded to
// nearest. Source: ITU-R BT.709-6, 3.2 to 4.6. Converts back, also from BT.601. Source of its matrix:
// ITU-R BT.601-7, 2.5.
#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string_view>

#include "ods/base/names.h"
#include "ods/camera/layout.h"

namespace ods {

// Chroma subsampling. Chroma is co-sited with the left pixels and half way between rows: the mean of both rows and,
// horizontally, of the pixel and its neighbours weighted 1 2 1.
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

// Y, Cb and Cr of a frame or a part of it; rows are `stride` bytes apart. 8 bits use bytes, more use 16-bit words.
struct Planes {
  int bits = 8;
  Chroma chroma = Chroma::k420;
  std::array<std::byte*, 3> first{};
  std::array<size_t, 3> stride{};

  // The planes from this pixel on. Precondition: it starts a chroma block.
  Planes at(int x, int y) const;
};

// Fills `row` with a row's red, then green, then blue: display-encoded, 0..1. Called concurrently.
using CodeRows = std::function<void(int y, std::span<float> row)>;

// Converts an image into its planes; chroma does not filter across its borders. Precondition: `size` is a multiple of
// the chroma block.
void put_ycbcr(const CodeRows& rows, Extent size, const Planes& planes);

// The encoding of a video's numbers.
struct ColorCode {
  bool is_601 = false;          // BT.601's matrix, else BT.709's
  bool has_full_range = false;  // black is 0, white the largest number
  bool operator==(const ColorCode&) const = default;
};

// Fills `row`, laid out as in CodeRows, with pixels of row y from column `first` on; values may lie outside 0..1.
// Chroma is interpolated linearly within the image.
void get_codes(const Planes& planes, Extent size, const ColorCode& color, int y, int first, std::span<float> row);

}  // namespace ods
