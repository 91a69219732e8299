// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a pixel averages of the picture that it is made of.
//
// A pixel that covers s texels along an axis of its footprint is the mean of the picture under a tent of variance
// (s^2 - 1) / 6: together with what the texels have averaged already, that of a tent as wide as the pixel's distance to
// its neighbours on either side. The tent is summed over points not more than half a texel or so apart. Between texels
// the picture is interpolated by Catmull and Rom's cubic, kept within the range of its 4x4 texels. So a pixel that
// covers one texel or less is interpolated only, and one in the middle of a texel is that texel, bit for bit.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "ods/kernel/math.h"

namespace ods {

// How the place moves from one pixel to the next, in texels.
struct Footprint {
  vec2 dx{0.0f};  // to the right
  vec2 dy{0.0f};  // down
};

struct FilterPoint {
  vec2 texels;  // from the pixel's place
  vec2 pixels;  // the same in the picture that is made, from the pixel's middle
  float weight;
};

// The points over which a pixel is summed; their weights are 1 together. `points` is overwritten.
void filter_points(const Footprint& footprint, std::vector<FilterPoint>& points);

// The same of a footprint whose axes are about the picture's own, for which columns and rows have weights each by
// themselves: a sixth of the work. Up to a radius of 3 texels weights come from a table, of the tent in it whose
// variance is nearest: at most 1/576 of a square texel off.
struct TexelTents {
  float across = 0.0f;  // the tents' radius in texels, squared; 0: the picture is interpolated only
  float down = 0.0f;
};

// None of other footprints and of very large ones.
std::optional<TexelTents> texel_tents(const Footprint& footprint);

struct TexelWeights {
  int first = 0;  // column or row of the first weight
  int count = 0;
  float weights[32];
};
struct TexelFilter {
  TexelWeights across, down;
};

// The weights of such tents at places, which are quicker to find for several: a filter for each.
constexpr size_t kMaxAlike = 8;
void texel_filters(const TexelTents& tents, std::span<const vec2> places, TexelFilter* filters);

}  // namespace ods
