// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Measures the displacement of each pixel of one eye's view in the other's, along its row, where the pixels have enough
// detail.
//
// Semi-global matching: the Hamming distance of census transforms, smoothed along eight paths, checked from the other
// eye's side. Sources: Zabih, Woodfill, "Non-parametric Local Transforms for Computing Visual Correspondence", 1994;
// Hirschmueller, "Stereo Processing by Semi-Global Matching and Mutual Information", 2008. The paths go around the
// sphere, and the transform's window has the same width on the sphere at every elevation.
#pragma once
#include <array>

#include "ods/disparity/gray_view.h"

namespace ods {

struct DenseMatch {
  // For the left eye's view and for the right one's: theta in the left eye minus theta in the right one, radians, as
  // Match::around. NaN if the eyes differ, if the row has no distinct detail, or within 12 degrees of a pole.
  std::array<Image, 2> around;
  double share = 0.0;      // matched fraction of the left eye's view, by solid angle
  double precision = 0.0;  // radians on the great circle: typical difference between matches in the two directions
};

// The views must be two eyes of one picture, because smooth areas match in any two pictures. Finds parallax from 2
// degrees outwards to 20 degrees inwards. Precondition: both views have the same size.
DenseMatch match_densely(const GrayView& left, const GrayView& right);

}  // namespace ods
