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
#include <span>
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

// The same of a footprint whose axes are about the picture's own, for which columns and rows have weights each by
// themselves: a sixth of the work. False, and no filter, of other footprints and of very large ones.
struct TexelWeights {
  int first = 0;  // column or row of the first weight
  int count = 0;
  float weights[32];
};
struct TexelFilter {
  TexelWeights across, down;
};
bool texel_filter(const Footprint& footprint, vec2 at, TexelFilter& filter);

// Reads every layer at once; their channels follow each other.
class Resampler {
 public:
  // With adds_alpha there is one more channel, behind the colour's, for who sees more than the picture does.
  // Precondition: every eye of the picture has the same layers; adds_alpha: its colour has no alpha.
  explicit Resampler(const Source& source, bool adds_alpha = false);
  ~Resampler();

  int channels() const { return channels_; }

  // Adds what a place of a cell shows, by its weight. Layers that must not be averaged are left alone.
  void add(const Place& place, const Cell& cell, float weight, float* sums) const;

  // Whether a filter's texels are all of a cell's.
  bool has_all(const TexelFilter& filter, const Cell& cell) const;

  // Sets pixels beside each other, each with a filter of its own, to what they show; `out` is the first's. The same
  // layers are left alone. Precondition: has_all() of each.
  void fill(int eye, std::span<const TexelFilter> filters, float* out) const;

  // Sets what add() and fill() leave alone: those layers, to the texel of the place, and an alpha that is added to 1.
  void finish(const Place& place, float* out) const;

 private:
  struct Group;  // up to 4 channels of a layer

  const Source& source_;
  std::vector<Group> mixed_;
  std::vector<Group> nearest_;
  int channels_ = 0;
  int added_alpha_ = -1;  // its channel; below 0: there is none
};

// Pixels of a row that are filled together, because neighbours share texels.
class PixelRun {
 public:
  PixelRun(const Resampler& resampler, int eye, const Cell& cell) : resampler_(resampler), eye_(eye), cell_(cell) {}

  // Takes the pixel beside the last one; false: it has no texel_filter() whose texels are all of the cell, and is left
  // alone.
  bool add(const Footprint& footprint, vec2 at, float* pixel);

  // Fills those that still wait.
  void fill();

 private:
  const Resampler& resampler_;
  int eye_;
  Cell cell_;
  TexelFilter filters_[32];
  size_t waiting_ = 0;
  float* first_ = nullptr;  // of those that wait
};

}  // namespace ods
