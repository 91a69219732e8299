// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Measures the features that a projection leaves in a picture. Each mark of an eye is a number from -1 (certainly not)
// to 1 (certainly); 0 if the picture is inconclusive, because it has no detail there.
#pragma once
#include "ods/camera/projection.h"
#include "ods/image/image.h"

namespace ods {

// The marks of one eye, as a display shows it (ods/identify/thumbnail.h): 1 channel, 0..1, perhaps squeezed.
struct Marks {
  // Fisheyes leave the corners empty: everything outside the ellipse that touches the edges is black, and the ellipse
  // is not. `radius`: of the picture inside, in units of that ellipse.
  double circle = 0.0;
  double radius = 1.0;
  // Inside a circle. ball: near its rim, the picture varies more outwards than around, because all of the rim is one
  // point straight behind. dome: the picture gets brighter inwards rather than upwards, because the lens looks up.
  double ball = 0.0;
  double dome = 0.0;
  // The first and the last row of a lat-long are one point each, and the rows near them vary little from end to end.
  // `spread`: the variation there in units of rows farther away, for the end with more of it.
  double poles = 0.0;
  double spread = 1.0;
  // The right edge continues at the left edge.
  double closes = 0.0;
  double detail = 0.0;  // mean difference of adjacent texels, 0..1
};
// Computes the marks of an eye. other: the other eye, if there is one. A patch over the tripod is the same in both; the
// marks ignore it.
Marks marks_of(const Image& eye, const Image* other = nullptr);

// Evidence that every edge of the six faces continues at the adjacent face of this kind of cube.
double faces_join(const Image& eye, const ProjectionSetting& cube);

// Evidence that the picture is a grid of this many columns and rows, as of a cube's faces in any order: at least two
// borders between its cells are discontinuous. A single one might be an edge of the scene, or the horizon at the end of
// all cells of a row, which counts as one border.
double breaks_at_grid(const Image& eye, int columns, int rows);

// Evidence that the picture is discontinuous from top to bottom at its middle column, as two pictures side by side are.
double breaks_in_middle(const Image& eye);

}  // namespace ods
