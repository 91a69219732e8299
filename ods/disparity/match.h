// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds corresponding points in the two eyes: searches for tiles along the row, and a little above and below it, by
// normalised cross-correlation.
#pragma once
#include <optional>
#include <vector>

#include "ods/disparity/gray_view.h"

namespace ods {

// Angles are in radians. A tile has the same width on the sphere at every elevation:
// its columns grow towards the poles.
struct Search {
  int rows = 12;  // size of a tile, in pixels of the view
  int columns = 16;
  int step = 12;         // from one row of tiles to the next, in pixels of the view
  float around = 0.21f;  // search range to either side; half of the parallax at 0.3 m
  float down = 0.02f;
  float lowest = -1.2f;  // elevation of the tiles' centres
  float highest = 1.2f;
  float correlation = 0.75f;  // minimum correlation of a match
};

struct Match {
  float theta = 0.0f;  // the tile's centre
  float phi = 0.0f;
  float around = 0.0f;  // theta in the left eye minus theta in the right eye: for a parallel pair 2 asin(r / rho) >= 0
  float down = 0.0f;    // phi in the left eye minus phi in the right eye; 0 in every omni-directional stereo pair
  float correlation = 0.0f;
};

struct Matches {
  int tiles = 0;  // tiles with enough detail in both eyes to be searched for
  std::vector<Match> found;
  float pixel = 0.0f;  // size of a pixel of the view, radians

  // The matched fraction of these tiles.
  double share() const { return tiles > 0 ? static_cast<double>(found.size()) / tiles : 0.0; }
};

// Precondition: both views have the same size.
Matches match_tiles(const GrayView& left, const GrayView& right, const Search& search);

}  // namespace ods
