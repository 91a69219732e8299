// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture file seen from afar: small and grey, with its halves and faces where the file has them.
#pragma once
#include <vector>

#include "ods/camera/layout.h"
#include "ods/picture/stored_picture.h"

namespace ods {

struct Thumbnail {
  Extent file;  // pixels
  Image light;  // the file reduced to at most kThumbnailSide pixels a side: luminance, linear, 0..1; one channel
  // How much more neighbouring pixels differ than every other one, along a row and along a column. Above 1 in no
  // picture of one eye; so it is where every other column or row is another eye's.
  double other_columns = 0.0;
  double other_rows = 0.0;
  // Of four pixels in a square: how much more the diagonals differ than the rows, or the columns if they differ less.
  // About 1 of noise, less of a picture, more where pixels alternate like a checkerboard.
  double crossed = 0.0;
};

inline constexpr int kThumbnailSide = 1008;  // divisible by two eyes of six faces

// `whole`: a file read as one eye (Layout::kSeparate), whatever it shows. Scene-linear light is exposed so that its
// geometric mean becomes a middle grey.
Thumbnail make_thumbnail(const StoredPicture& whole);

// Both eyes of a file whose neighbouring pixels are different eyes', reduced likewise. Precondition: the size of the
// file allows that layout.
std::vector<Image> interleaved_eyes(const StoredPicture& whole, Layout layout);

// Its red, green and blue part, reduced to that size: linear, one channel each.
std::vector<Image> color_parts(const StoredPicture& whole, Extent size);

// Black bars at two opposite sides of a file, or at all four: equally wide at both, and with an edge to what they
// surround. None: no sides have them. `whole` as in make_thumbnail().
Bars bars_of(const StoredPicture& whole);

// What bars leave of a file: a view into its pixels.
StoredPicture without_bars(const StoredPicture& whole, const Bars& bars);

// As a display shows it, 0..1.
Image shown(const Image& light);

}  // namespace ods
