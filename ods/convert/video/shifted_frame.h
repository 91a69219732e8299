// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Handles conversions that only move pixels: another layout, a part of a lat-long picture such as vr180, a turn by
// whole pixels. Their frames are copied, number by number, including chroma.
#pragma once
#include <optional>
#include <vector>

#include "ods/convert/mapping.h"
#include "ods/video/ycbcr.h"

namespace ods {

// The position of a target's eye in the source: its pixel x, y is the source's x + column, y + row. Columns wrap
// around.
struct PixelShift {
  int source_eye = 0;  // index in the picture's eyes
  int column = 0;
  int row = 0;
};

// The shift of every eye of the target. Returns nullopt if any pixel would have to be computed. `block`: pixels that
// share chroma, which stay together.
std::optional<std::vector<PixelShift>> find_shifts(const Mapping& mapping, Extent block);

// Copies an eye. Precondition: both have the same bits and chroma.
void copy_shifted(const Planes& from, Extent from_size, const PixelShift& shift, const Planes& to, Extent to_size);

}  // namespace ods
