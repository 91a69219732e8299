// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reading a stored picture between its texels, in linear light, colour multiplied by alpha.
//
// A pixel that covers s texels along an axis of its footprint is the mean of the picture under a tent of variance
// (s^2 - 1) / 6: together with what the texels have averaged already, that of a tent as wide as the pixel's distance to
// its neighbours on either side. The tent is summed over points not more than half a texel or so apart. Between texels
// the picture is interpolated by Catmull and Rom's cubic, kept within the range of its 4x4 texels. So a pixel that
// covers one texel or less is interpolated only, and one in the middle of a texel is that texel, bit for bit.
#pragma once
#include <array>
#include <memory>
#include <vector>

#include "ods/image/source.h"

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

// Reads every layer at once; their channels follow each other.
class Resampler {
 public:
  // Precondition: every eye of the picture has the same layers.
  explicit Resampler(const Source& source);

  int channels() const { return channels_; }

  // Adds what a place shows, by its weight. Layers that must not be averaged are left alone.
  void add(const Place& place, float weight, float* sums) const;

  // Sets those layers, to the texel of the place.
  void set_nearest(const Place& place, float* out) const;

 private:
  // Adds 16 texels of up to 4 channels under weights.
  using AddTexels = void (*)(const std::byte* const* texels, const float* weights, float weight, float* sums);
  using ReadTexel = void (*)(const std::byte* texel, int count, float* out);

  struct Group {
    AddTexels add;
    ReadTexel read;  // of layers that must not be averaged
    size_t layer;
    ptrdiff_t offset;  // bytes, in a texel
    int first;         // channel of the whole
    int count;
  };

  const Source& source_;
  std::vector<Group> mixed_;
  std::vector<Group> nearest_;
  int channels_ = 0;
};

}  // namespace ods
