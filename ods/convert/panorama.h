// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Maps lines of sight to texels of a stored picture, and finds the texel next to another across a seam, a pole or an
// edge of a face, which is usually not the adjacent texel in the file.
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
  bool other_above = false;  // beyond this pole the picture continues in the other eye's, because it has no merge there
  bool other_below = false;
  std::optional<EyeCorrection> right;  // corrects the right eye's lines of sight, if set
};

// The picture must outlive the source and must not move. Precondition: it has eyes.
Source make_source(const StoredPicture& picture);

// A position in the picture.
struct Place {
  int source_eye = 0;  // index in StoredPicture::eyes
  vec2 at{0.0f};       // pixels from the left and top edge: the centre of the first texel is 0.5
  bool seen = false;   // false if the picture is empty there
};

// Texels that are contiguous in the world: a face, or a whole picture. right and bottom are exclusive.
struct Cell {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
};

// Precondition: both are cells of one picture.
inline bool same_cell(const Cell& a, const Cell& b) {
  return a.left == b.left && a.top == b.top;
}

struct Texel {
  int source_eye = 0;  // index in StoredPicture::eyes
  int x = 0;
  int y = 0;
};

// The index of an eye (kLeft, kRight, kMono) in the picture; 0 if the picture does not have it.
int eye_index(const StoredPicture& picture, int eye);

// Returns whether the viewing circle is not merged at the pole, so that a picture continues beyond it in the other
// eye's picture.
bool is_apart_at_pole(const Camera& camera, bool above);

// The index of the eye that shows a line beyond a pole: the other eye, or the same one if they are merged there.
int eye_over_pole(const Source& source, int source_eye, bool above);

// The position of a line of sight in an eye's picture. source_eye: index in StoredPicture::eyes. direction: in the
// world, any length but 0.
Place place_of_line(const Source& source, int source_eye, vec3 direction);

// The cell of a position in an eye's picture of this size. A position on the border of two cells belongs to the right
// or lower one; place_of_line() avoids borders.
Cell cell_of(const Projection& projection, Extent size, vec2 at);

// Returns whether a texel is inside a cell and inside the picture.
bool has_texel(const Source& source, const Cell& cell, int x, int y);

// The texel at x, y of an eye's picture. Outside the cell, this is the texel that shows the adjacent part of the world;
// if there is none, the nearest one at the cell's edge.
Texel texel_of(const Source& source, int source_eye, const Cell& cell, int x, int y);

}  // namespace ods
