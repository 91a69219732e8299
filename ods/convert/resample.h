// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reading a stored picture between its texels (texel_filter.h), in linear light, colour multiplied by alpha.
#pragma once
#include <span>
#include <vector>

#include "ods/convert/panorama.h"
#include "ods/convert/texel_filter.h"

namespace ods {

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

  // Whether all texels of filters are a cell's.
  bool has_all(std::span<const TexelFilter> filters, const Cell& cell) const;

  // Sets pixels beside each other, each with a filter of its own, to what they show; `out` is the first's. The same
  // layers are left alone. Precondition: has_all() of them.
  void fill(int eye, std::span<const TexelFilter> filters, float* out) const;

  // Sets the pixels of a row to the texels of a row of the picture.
  void copy(int eye, int y, std::span<float> out) const;

  // Sets what add() and fill() leave alone: those layers, to the texel of the place, and an alpha that is added to 1.
  void finish(const Place& place, float* out) const {
    if (leaves_some_alone_) set_rest(place, out);
  }

 private:
  struct Group;  // up to 4 channels of a layer

  void set_rest(const Place& place, float* out) const;

  const Source& source_;
  std::vector<Group> mixed_;
  std::vector<Group> nearest_;
  int channels_ = 0;
  int added_alpha_ = -1;  // its channel; below 0: there is none
  bool leaves_some_alone_ = false;
};

// Pixels of a row that are filled together, because neighbours share texels.
class PixelRun {
 public:
  PixelRun(const Resampler& resampler, int eye, const Cell& cell) : resampler_(resampler), eye_(eye), cell_(cell) {}

  // Takes the pixels beside the last one, at most kMaxAlike; false: their texels are not all of the cell, or they have
  // no tents, and they are left alone.
  bool add(const std::optional<TexelTents>& tents, std::span<const vec2> places, float* pixels);

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
