// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The two codecs of Basis Universal, which code pictures in blocks of 4x4 texels.
// Both throw MalformedFile.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ods/image/image_file.h"

namespace ods {

// Texels as in CodeImage, row by row.
using TexelBlock = std::array<uint32_t, 16>;

inline uint32_t pack_texel(uint32_t r, uint32_t g, uint32_t b, uint32_t a) {
  return r | g << 8 | b << 16 | a << 24;
}

inline size_t blocks_along(int side) {
  return (static_cast<size_t>(side) + 3) / 4;
}

// Writes the part of block (x, y) that is inside the picture.
void put_block(CodeImage& image, size_t x, size_t y, const TexelBlock& texels);

// Decodes ETC1S in BasisLZ: the first of `image_count` pictures, in `level`. `global`: the supercompression global data
// of KTX 2.0. Alpha is the second slice's green, 255 without one. A picture that is a difference from another is
// rejected.
void decode_basis_lz(std::span<const std::byte> global, size_t image_count, std::span<const std::byte> level,
                     CodeImage& image);

inline constexpr size_t kUastcBlockBytes = 16;

// Decodes UASTC LDR 4x4, a block of 16 bytes. Throws MalformedFile for invalid blocks.
TexelBlock decode_uastc(std::span<const std::byte> block);

}  // namespace ods
