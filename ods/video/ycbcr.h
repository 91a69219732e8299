// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Converts display-encoded RGB to a video's Y'CbCr, rounded to nearest, and back: by the matrix of BT.709, BT.601 or
// BT.2020 with non-constant luminance, in limited range (black 16, white 235 at 8 bits) or full range.
// Sources: ITU-R BT.709-6, 3.2 to 4.6; ITU-R BT.601-7, 2.5; ITU-R BT.2020-2, table 4; ITU-R BT.2100-2, tables 6 and 9.
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
// horizontally, of the pixel and the adjacent ones, weighted 1 2 1.
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

// Y, Cb and Cr of a frame or a part of it; rows are `stride` bytes apart. 8 bits are stored in bytes, more in 16-bit
// words.
struct Planes {
  int bits = 8;
  Chroma chroma = Chroma::k420;
  std::array<std::byte*, 3> first{};
  std::array<size_t, 3> stride{};

  // The planes from this pixel on. Precondition: it starts a chroma block.
  Planes at(int x, int y) const;
};

// Fills `row` with a row's red, then green, then blue: display-encoded, black is 0 and white is 1. Called concurrently.
using CodeRows = std::function<void(int y, std::span<float> row)>;

enum class YcbcrMatrix { k709, k601, k2020 };

// The encoding of a video's numbers.
struct ColorCode {
  YcbcrMatrix matrix = YcbcrMatrix::k709;
  bool has_full_range = false;  // black is 0, white the largest number
  bool operator==(const ColorCode&) const = default;
};

// Converts an image into its planes; chroma does not filter across its borders. Values outside 0..1 are clamped to the
// range of the codes. Precondition: `size` is a multiple of the chroma block.
void put_ycbcr(const CodeRows& rows, Extent size, const Planes& planes, const ColorCode& color = {});

// Converts several rows at once, at most kMaxCodeRows: `rows` are laid out as in CodeRows, one after the other.
constexpr int kMaxCodeRows = 16;
using CodeBands = std::function<void(int y, int count, std::span<float> rows)>;
void put_ycbcr_bands(const CodeBands& bands, Extent size, const Planes& planes, const ColorCode& color = {});

// Fills `row`, laid out as in CodeRows, with pixels of row y from column `first` on; values may be outside 0..1. Chroma
// is interpolated linearly within the image.
void get_codes(const Planes& planes, Extent size, const ColorCode& color, int y, int first, std::span<float> row);

}  // namespace ods
