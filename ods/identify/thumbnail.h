// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A small grey copy of a picture file, in which the file's halves and faces stay aligned with pixels.
#pragma once
#include <vector>

#include "ods/camera/layout.h"
#include "ods/picture/stored_picture.h"

namespace ods {

struct Thumbnail {
  Extent file;  // pixels
  Image light;  // the file reduced to at most kThumbnailSide pixels a side: luminance, linear, 0..1; one channel
  // The ratio of the differences of adjacent pixels to the differences of every other one, along a row and along a
  // column. Never above 1 for a picture of one eye; above 1 if columns or rows alternate between the eyes.
  double other_columns = 0.0;
  double other_rows = 0.0;
  // In 2x2 blocks: the ratio of diagonal difference to the smaller of row and column difference. About 1 for noise,
  // less for a picture, more if pixels alternate like a checkerboard.
  double crossed = 0.0;
  // The mean of that diagonal difference, and of the differences of adjacent pixels in a row and in a column, as
  // displayed, 0..1.
  double diagonal = 0.0, beside = 0.0, below = 0.0;
};

inline constexpr int kThumbnailSide = 1008;  // divisible by two eyes of six faces

// Makes the thumbnail. whole: a file read as one eye (Layout::kSeparate), regardless of its layout. Scene-linear light
// is exposed so that its geometric mean becomes middle grey.
Thumbnail make_thumbnail(const StoredPicture& whole);

// Both eyes of a file whose adjacent pixels belong to different eyes, reduced in the same way. Precondition: the size
// of the file allows that layout.
std::vector<Image> interleaved_eyes(const StoredPicture& whole, Layout layout);

// The red, green and blue part, reduced to that size: linear, one channel each.
std::vector<Image> color_parts(const StoredPicture& whole, Extent size);

// Returns whether all four corners of the file are entirely transparent, as around a drawing.
bool has_clear_corners(const StoredPicture& whole);

// Returns whether the file is a drawing, a page or a plot: one colour makes up most of each of its four edges, and much
// of the rest. min_black: the share of the picture that a black ground must cover, because the circles of lenses have
// black around them, too.
bool has_one_ground(const StoredPicture& whole, double min_black = 0.5);

// Black bars at two opposite sides of a file, or at all four: equally wide at both, with an edge towards the picture.
// Returns no bars if no sides have them. `whole` as in make_thumbnail().
Bars bars_of(const StoredPicture& whole);

// The file without its bars: a view into its pixels.
StoredPicture without_bars(const StoredPicture& whole, const Bars& bars);

// Converts linear light to display values, 0..1.
Image shown(const Image& light);

}  // namespace ods
