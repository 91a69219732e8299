// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Moves the eyes of a lat-long picture by its depth, row by row: the same points that meet_surface() finds for each
// pixel, at the cost of a few operations per texel, for any displacement.
//
// If both cameras are symmetric about the same upright axis, the shift of the surfaces along a target row depends only
// on their nearness, not on their heading: one short table per row gives the shift in columns, and their row in the
// picture. Every texel is a point on the target row, and between adjacent texels of one surface the row is a line; of
// several surfaces on one pixel, the closest counts. Between texels of different surfaces the line is cut half way, and
// the farther texel, which has mixed colours, is left out.
#pragma once
#include <optional>
#include <vector>

#include "ods/convert/mapping.h"
#include "ods/convert/reproject.h"

namespace ods {

class RowWarp {
 public:
  // Returns nullopt for other cameras, pictures of other projections, and a target that is smaller than the picture.
  // Both must outlive the result and must not move.
  static std::optional<RowWarp> make(const Mapping& mapping, const Reprojection& reprojection);

  // Finds the hits of all pixels of row y of the target's eye with this index. Returns false if surfaces cross too many
  // rows there, as near the poles.
  bool warp(int index, int y, bool fills, std::vector<SurfaceHit>& row) const;

 private:
  RowWarp(const Mapping& mapping, const Reprojection& reprojection);

  const Mapping* mapping_;
  const Reprojection* reprojection_;
  float scale_;        // texels per pixel
  float period_;       // pixels per turn; 0 if the picture is not a full turn
  float one_surface_;  // maximum relative difference of the nearness of adjacent texels
};

}  // namespace ods
