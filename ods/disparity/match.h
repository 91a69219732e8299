// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the one eye's picture shows what the other's does: tiles are searched along the row, and a little above and
// below, by normalised cross-correlation.
#pragma once
#include <optional>
#include <vector>

#include "ods/disparity/gray_view.h"

namespace ods {

// Radians. A tile is as wide on the sphere wherever it lies: its columns grow towards the poles.
struct Search {
  int rows = 12;  // of a tile, pixels of the view
  int columns = 16;
  int step = 12;         // from one row of tiles to the next
  float around = 0.21f;  // how far to search to either side; half of parallax at 0.3 m
  float down = 0.02f;
  float lowest = -1.2f;  // middles of the tiles
  float highest = 1.2f;
  float correlation = 0.75f;  // of a match, at least
};

struct Match {
  float theta = 0.0f;  // of the tile's middle
  float phi = 0.0f;
  float around = 0.0f;  // theta in the left eye less theta in the right one: of a parallel pair 2 asin(r / rho) >= 0
  float down = 0.0f;    // phi likewise; 0 in every omni-directional stereo pair
  float correlation = 0.0f;
};

struct Matches {
  int tiles = 0;  // with enough detail in both eyes to be looked for
  std::vector<Match> found;
  float pixel = 0.0f;  // of the view, radians

  // Tiles that were found among those looked for.
  double share() const { return tiles > 0 ? static_cast<double>(found.size()) / tiles : 0.0; }
};

// Precondition: views of one size.
Matches match_tiles(const GrayView& left, const GrayView& right, const Search& search);

}  // namespace ods
