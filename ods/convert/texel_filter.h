// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The filter of a conversion: the area of the source picture that a target pixel averages.
//
// A pixel whose footprint covers s texels along an axis is the mean of the picture under a tent of the variance
// (s^2 - 1) / 6. Together with the averaging that the texels already contain, this is a tent as wide as the pixel's
// distance to the adjacent pixels on either side. The tent is summed over points at most about half a texel apart.
// Between texels the picture is interpolated by the Catmull-Rom cubic, clamped to the range of its 4x4 texels. So a
// pixel that covers one texel or less is only interpolated, and a pixel at the centre of a texel is that texel, bit for
// bit.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "ods/kernel/math.h"

namespace ods {

// The movement of the source position from one target pixel to the next, in texels.
struct Footprint {
  vec2 dx{0.0f};  // to the right
  vec2 dy{0.0f};  // down
};

struct FilterPoint {
  vec2 texels;  // offset from the pixel's position in the source
  vec2 pixels;  // the same offset in the target, from the pixel's centre
  float weight;
};

// The points of a pixel's sum; their weights add up to 1. Overwrites `points`.
void filter_points(const Footprint& footprint, std::vector<FilterPoint>& points);

// The same filter for a footprint whose axes are nearly the picture's own: columns and rows have separate weights,
// which takes a sixth of the time. Up to a radius of 3 texels the weights come from a table, for the tent with the
// nearest variance: the error is at most 1/576 square texel.
struct TexelTents {
  float across = 0.0f;  // squared radius of the tents, in texels; 0 if the picture is only interpolated
  float down = 0.0f;

  bool operator==(const TexelTents&) const = default;
};

// Returns nullopt for other footprints and for very large ones.
std::optional<TexelTents> texel_tents(const Footprint& footprint);

struct TexelWeights {
  int first = 0;  // column or row of the first weight
  int count = 0;
  float weights[32];
};
struct TexelFilter {
  TexelWeights across, down;
};

// Fills one filter per position with the weights of such tents; several positions (at most kMaxAlike) at once are
// faster.
constexpr size_t kMaxAlike = 8;
void texel_filters(const TexelTents& tents, std::span<const vec2> places, TexelFilter* filters);

}  // namespace ods
