// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How far each pixel of one eye's view is moved in the other's, along its row, where pixels tell.
//
// Semi-global matching: the Hamming distance of census transforms, smoothed along eight paths, checked from the other
// eye's side. Sources: Zabih, Woodfill, "Non-parametric Local Transforms for Computing Visual Correspondence", 1994;
// Hirschmueller, "Stereo Processing by Semi-Global Matching and Mutual Information", 2008. The paths go around the
// sphere, and the transform's window is as wide on the sphere at every elevation.
#pragma once
#include <array>

#include "ods/disparity/gray_view.h"

namespace ods {

struct DenseMatch {
  // Of the left eye's view and of the right one's: theta in the left eye minus theta in the right one, radians, as
  // Match::around. NaN: the eyes differ, or nothing in the row tells places apart, or it is within 12 degrees of a
  // pole.
  std::array<Image, 2> around;
  double share = 0.0;      // of what the left eye shows, by solid angle: matched
  double precision = 0.0;  // radians on the great circle: how far apart most matches there and back are
};

// The views must be two eyes of one picture: what is smooth matches something in any other. Parallax is found from 2
// degrees outwards up to 20 degrees inwards. Precondition: both views have the same size.
DenseMatch match_densely(const GrayView& left, const GrayView& right);

}  // namespace ods
