// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a stored picture has its pixels: which texel a line of sight meets, and which lies beside another across a
// seam, a pole, an edge of a face. Never a neighbour in the file by accident.
//
// A line of sight is known by its direction alone: pictures with one viewing circle and one merge have the same lines,
// and differ in where they put them. Toe-in on a distance C also shrinks the circle, to cos(atan(r / (C cos phi))) of
// it: by a thousandth at 45 degrees, for r = 32.5 mm and C = 1 m. That is left out. Above atan(C / r) toe-in has no
// lines; its last ones stand in.
#pragma once
#include "ods/picture/stored_picture.h"

namespace ods {

struct Source {
  const StoredPicture* picture = nullptr;
  Camera camera;             // how it was taken, the centre at 0
  bool other_above = false;  // the picture goes on over this pole in the other eye's: the circle is not merged there
  bool other_below = false;
};

// The picture stays where it is while the source is used. Precondition: it has eyes.
Source make_source(const StoredPicture& picture);

// A place in the picture.
struct Place {
  int eye = 0;        // index in StoredPicture::eyes
  vec2 at{0.0f};      // pixels from the left and top edge: the middle of the first texel is 0.5
  bool seen = false;  // false: the picture has nothing there
};

// Texels that lie together as the world does: a face, or all of a picture. right and bottom are not part of it.
struct Cell {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
};

struct Texel {
  int eye = 0;
  int x = 0;
  int y = 0;
};

// The index of an eye (kLeft, kRight, kMono) in the picture; of an eye that it lacks: the first.
int eye_index(const StoredPicture& picture, int eye);

// The viewing circle is not merged at the pole: who goes on over it comes into the other eye's picture.
bool is_apart_at_pole(const Camera& camera, bool above);

// The index of the eye that shows a line which passed over a pole: the other one, or the same where they are merged.
int eye_over_pole(const Source& source, int eye, bool above);

// Where the line of this direction (the world's, any length but 0) lies in the picture of the eye of an index.
Place place_of_line(const Source& source, int eye, vec3 direction);

// The cell of a place in an eye's picture of a size. A place on the border of two belongs to the one after it;
// place_of_line() keeps off borders.
Cell cell_of(const Projection& projection, Extent size, vec2 at);

// Whether a texel is one of a cell's, and in the picture.
bool has_texel(const Source& source, const Cell& cell, int x, int y);

// The texel that the world has at x, y of a cell, which may lie outside; where there is none, the nearest of the edge.
Texel texel_of(const Source& source, int eye, const Cell& cell, int x, int y);

}  // namespace ods
