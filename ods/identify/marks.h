// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What only one kind of projection does to a picture, measured. Each mark of an eye is a number from -1 (certainly
// not) to 1 (certainly); 0 if the picture does not tell, because it has no detail there.
#pragma once
#include "ods/camera/projection.h"
#include "ods/image/image.h"

namespace ods {

// One eye, as a display shows it (ods/identify/thumbnail.h): 1 channel, 0..1, perhaps squeezed.
struct Marks {
  // Fisheyes leave the corners empty: everything outside the ellipse that touches the edges is black, and the ellipse
  // is not. `radius`: that of the picture inside, in units of that ellipse.
  double circle = 0.0;
  double radius = 1.0;
  // Inside a circle: whether it differs more outwards than around near its rim, as where all of that is one point,
  // straight behind; and whether the picture grows brighter inwards, as where the lens looks up, rather than upwards.
  double ball = 0.0;
  double dome = 0.0;
  // The first and the last row of a lat-long are one point each, and the rows near them differ little from end to end.
  // `spread`: how much they do, in units of rows farther off; of the end where it is more.
  double poles = 0.0;
  double spread = 1.0;
  // The left edge goes on where the right one ends.
  double closes = 0.0;
  double detail = 0.0;  // the mean difference of neighbours, 0..1
};
// other: the other eye, if there is one. What covers the tripod is the same in both, and no mark counts it.
Marks marks_of(const Image& eye, const Image* other = nullptr);

// Six faces: whether every edge of a face goes on where this kind of cube has it in the world.
double faces_join(const Image& eye, const ProjectionSetting& cube);

// Whether the picture is put together of parts in a grid of this many columns and rows, as of faces in any order: two
// borders between its cells break, or more. One might be an edge of the scene; so might all cells of a row end at one,
// the horizon, and count as one border.
double breaks_at_grid(const Image& eye, int columns, int rows);

// Whether the picture breaks from top to bottom at its middle column, as two pictures beside each other do.
double breaks_in_middle(const Image& eye);

}  // namespace ods
