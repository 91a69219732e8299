// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a stored picture has its pixels: which texel a line of sight meets, and which texel is next to another across a
// seam, a pole or an edge of a face. It is never merely the neighbour in the file.
//
// A line of sight is identified by its direction alone (ods/kernel/camera/line.h). Toe-in at a distance C also shrinks
// the circle, by the factor cos(atan(r / (C cos phi))): a reduction by a thousandth at 45 degrees, for r = 32.5 mm and
// C = 1 m. This is ignored. Above the elevation atan(C / r) toe-in has no lines; the last ones are used instead.
#pragma once
#include <optional>

#include "ods/camera/eye_correction.h"
#include "ods/picture/stored_picture.h"

namespace ods {

struct Source {
  const StoredPicture* picture = nullptr;
  Camera camera;             // the camera that took it, with its centre at 0
  bool other_above = false;  // the picture continues over this pole in the other eye's: it has no merge there
  bool other_below = false;
  std::optional<EyeCorrection> right;  // where the right eye's picture has its lines of sight; none: in their places
};

// The picture must outlive the source and must not move. Precondition: it has eyes.
Source make_source(const StoredPicture& picture);

// A place in the picture.
struct Place {
  int source_eye = 0;  // index in StoredPicture::eyes
  vec2 at{0.0f};       // pixels from the left and top edge: the centre of the first texel is 0.5
  bool seen = false;   // false: the picture has nothing there
};

// Texels that are contiguous in the world: a face, or a whole picture. right and bottom are exclusive.
struct Cell {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
};

// Of cells of one picture.
inline bool same_cell(const Cell& a, const Cell& b) {
  return a.left == b.left && a.top == b.top;
}

struct Texel {
  int source_eye = 0;  // index in StoredPicture::eyes
  int x = 0;
  int y = 0;
};

// The index of an eye (kLeft, kRight, kMono) in the picture; 0 if the picture lacks it.
int eye_index(const StoredPicture& picture, int eye);

// Whether the viewing circle is not merged at the pole, so that a picture continues over it in the other eye's picture.
bool is_apart_at_pole(const Camera& camera, bool above);

// The index of the eye that shows a line beyond a pole: the other eye, or the same one if they are merged there.
int eye_over_pole(const Source& source, int source_eye, bool above);

// The place of a line of sight in an eye's picture. source_eye: index in StoredPicture::eyes. direction: in the world,
// any length but 0.
Place place_of_line(const Source& source, int source_eye, vec3 direction);

// The cell of a place in an eye's picture of this size. A place on the border of two cells belongs to the right or
// lower one; place_of_line() avoids borders.
Cell cell_of(const Projection& projection, Extent size, vec2 at);

// Whether a texel is inside a cell and inside the picture.
bool has_texel(const Source& source, const Cell& cell, int x, int y);

// The texel at x, y of an eye's picture. Outside the cell: the texel that shows what the world has there; if there is
// none, the nearest one at the cell's edge.
Texel texel_of(const Source& source, int source_eye, const Cell& cell, int x, int y);

}  // namespace ods
