// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Decides for each piece whether the panorama from the middle shows it, other places in the box see it, or no place does.
// Divides pieces that are only partly seen, and those that their page would show distorted.
#pragma once
#include <vector>

#include "ods/layers/pieces.h"

namespace ods {

// The pages of the panorama from the middle, with the surface whose light each texel holds. At the silhouette of a near
// surface, texels up to kReach beyond it hold its light as well, because a simplified triangle may extend there and
// filters mix neighbours.
class PanoramaPages {
 public:
  static constexpr int kReach = 2;

  // The probe must outlive this object.
  explicit PanoramaPages(const Probe& probe);

  const Probe& probe() const { return probe_; }
  const PageGrid& grid() const { return probe_.grid; }

  // The texel whose surface a texel shows: itself, or a nearer one beside it.
  size_t source(size_t texel) const;

  // The point that a texel shows, relative to the middle. Precondition: it does not show the sky.
  vec3 point(size_t source) const;

  // The side of an instance that a texel shows, as in Probe::instances.
  int side(size_t texel) const { return probe_.instances[source(texel)]; }

  // Returns whether a texel shows the plane through a point, within a tolerance and a pixel.
  bool shows(size_t texel, vec3 on_plane, vec3 normal, float tolerance) const;

 private:
  const Probe& probe_;
  std::vector<int8_t> shifts_;  // by texel: (dy + kReach) * (2 kReach + 1) + dx + kReach
};

// The pixel of a panorama this wide, radians.
float pixel_angle(int width);

// Metres by which a point of a piece may lie in front of the scene's surface or behind it. cosine: between the ray and
// the surface's normal.
float depth_tolerance(const PieceMesh& mesh, float cosine);

// Returns whether a place sees a point of a piece with a normal, or a point up to `reach` texels of its map beside it.
// Both are relative to the middle.
bool sees(const DistanceMap& map, const PieceMesh& mesh, vec3 point, vec3 normal, int reach = 1);

// Gives every piece of a mesh its state.
void decide_pieces(const PanoramaPages& pages, PieceMesh& mesh, float pixel);

}  // namespace ods
