// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Charts: textures for the pieces that the panorama from the middle does not show. A chart is a connected, nearly flat
// part of a surface, as the place that sees it best sees it: it has as many texels as a panorama from there.
#pragma once
#include <vector>

#include "ods/layers/visibility.h"

namespace ods {

struct Chart {
  size_t mesh = 0;             // index of its PieceMesh
  std::vector<size_t> pieces;  // in that mesh
  int place = kMiddle;         // the place that sees it best
  vec3 origin{0.0f};           // relative to the middle of the box
  vec3 across{0.0f};  // texels per metre to the right and downwards: texel = corner + (dot(across, p - origin),
  vec3 down{0.0f};    // dot(down, p - origin))
  int width = 0;      // texels, with the gutters; 1 x 1 for the smallest, which have none
  int height = 0;
  int texture = 0;  // set by pack_charts()
  int x = 0;
  int y = 0;

  static constexpr int kGutter = 2;
};

// The position of a point in the chart's texture, in texels.
vec2 in_chart(const Chart& chart, vec3 point);

// Collects the pieces of the state kChart in charts for textures of size x size texels.
std::vector<Chart> make_charts(const Probe& probe, const std::vector<PieceMesh>& meshes, float pixel, int size);

// Makes charts of a mesh that is not seen from known places: each shows its surface from straight in front, with texels
// of this size in metres. index: Chart::mesh. max_extent: texels of a chart of several pieces.
std::vector<Chart> flat_charts(const PieceMesh& mesh, size_t index, float texel, float max_extent);

// Gives charts their places in textures of size x size texels, from texture number `first` on. Returns the number of
// textures. Precondition: no chart is larger than a texture.
int pack_charts(std::vector<Chart*> charts, int size, int first);

}  // namespace ods
