// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Samples a stored picture between its texels (texel_filter.h), in linear light, premultiplied.
#pragma once
#include <span>
#include <vector>

#include "ods/convert/panorama.h"
#include "ods/convert/texel_filter.h"

namespace ods {

// A picture whose texels are computed when read: only its colour, in linear light.
class TexelReader {
 public:
  virtual ~TexelReader() = default;
  // Writes R, G, B and an unused number for every texel of the box, row by row. May be called concurrently.
  // Precondition: the box is in the picture.
  virtual void read(int source_eye, const Cell& box, float* out) const = 0;
};

// Texels that are read once and used for many pixels.
struct TexelBlock {
  int source_eye = 0;
  Cell box;
  std::vector<float> texels;  // four numbers per texel
};

// Reads all layers at once; their channels are consecutive.
class Resampler {
 public:
  // Only the format of `source`'s picture is used.
  Resampler(const Source& source, const TexelReader& reader);

  // adds_alpha: adds one channel after the colour's, for a target that covers more directions than the picture.
  // Precondition: every eye of the picture has the same layers; if adds_alpha, its colour has no alpha.
  explicit Resampler(const Source& source, bool adds_alpha = false);
  ~Resampler();

  int channels() const { return channels_; }

  // Adds the picture's value at a position in a cell, times `weight`. Skips layers that must not be averaged.
  void add(const Place& place, const Cell& cell, float weight, float* sums) const;

  // Returns whether all texels of the filters are in the cell.
  bool has_all(std::span<const TexelFilter> filters, const Cell& cell) const;

  // Sets adjacent pixels to the filtered picture, each with its own filter; `out` is the first pixel. Skips the same
  // layers. Uses the texels of the block if it contains them; it may be null. Precondition: has_all() is true.
  void fill(int source_eye, std::span<const TexelFilter> filters, float* out, const TexelBlock* block = nullptr) const;

  // Fills a block for its box. Precondition: constructed with a TexelReader.
  void read(TexelBlock& block) const;

  // Copies a row of the picture to a row of pixels.
  void copy(int source_eye, int y, std::span<float> out) const;

  // Sets the channels that add() and fill() skip: those layers, to the texel at the position, and an added alpha, to 1.
  void finish(const Place& place, float* out) const {
    if (leaves_some_alone_) set_rest(place, out);
  }

 private:
  struct Group;  // up to 4 channels of a layer

  void set_rest(const Place& place, float* out) const;

  const Source& source_;
  const TexelReader* reader_ = nullptr;
  std::vector<Group> mixed_;
  std::vector<Group> nearest_;
  int channels_ = 0;
  int added_alpha_ = -1;  // channel of the added alpha; negative if there is none
  bool leaves_some_alone_ = false;
};

// Pixels of a row that are filled together, because adjacent ones share texels.
class PixelRun {
 public:
  PixelRun(const Resampler& resampler, int source_eye, const Cell& cell, const TexelBlock* block = nullptr)
      : resampler_(resampler), source_eye_(source_eye), cell_(cell), block_(block) {}

  // Queues the pixels after the last one, at most kMaxAlike. Returns false and queues nothing if some of their texels
  // are outside the cell, or `tents` is empty.
  bool add(const std::optional<TexelTents>& tents, std::span<const vec2> places, float* pixels);

  // Fills the queued pixels.
  void fill();

 private:
  const Resampler& resampler_;
  int source_eye_;
  Cell cell_;
  const TexelBlock* block_;
  TexelFilter filters_[32];
  size_t waiting_ = 0;
  float* first_ = nullptr;  // the first queued pixel
};

}  // namespace ods
