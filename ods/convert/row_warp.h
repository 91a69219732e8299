// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Moves the eyes of a lat-long picture by its depth, a row at a time: what meet_surface() finds pixel by pixel, at the
// cost of a few operations per texel, however far things move.
//
// Where both cameras are symmetric about the same upright axis, the surfaces along a target row move by their nearness
// alone, whatever their heading: one short table per row tells by how many columns, and in which row of the picture
// they are. Every texel is a point on the target row, and between neighbours of one surface the row is a line; of what
// lies on one pixel, the nearest counts. Where neighbours are not of one surface the line is cut, half way between
// them, and the texel of the farther one that has colours of both is left out.
#pragma once
#include <optional>
#include <vector>

#include "ods/convert/mapping.h"
#include "ods/convert/reproject.h"

namespace ods {

class RowWarp {
 public:
  // Nothing for other cameras, pictures of other projections, and a target that is smaller than the picture. Both must
  // outlive the result and must not move.
  static std::optional<RowWarp> make(const Mapping& mapping, const Reprojection& reprojection);

  // What each pixel of row y of the target's eye with this index meets. False: it cannot tell, because surfaces cross
  // many rows there, as they do near the poles.
  bool warp(int index, int y, bool fills, std::vector<SurfaceHit>& row) const;

 private:
  RowWarp(const Mapping& mapping, const Reprojection& reprojection);

  const Mapping* mapping_;
  const Reprojection* reprojection_;
  float scale_;        // texels per pixel
  float period_;       // pixels of a turn; 0: the picture is no whole turn
  float one_surface_;  // how much neighbours' nearness may differ, as a share
};

}  // namespace ods
