// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A rendered view of a rig of slits, sampled along rays of the stitched picture.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "ods/convert/reproject.h"
#include "ods/convert/resample.h"
#include "ods/picture/save.h"
#include "ods/stitch/slit_rows.h"

namespace ods {

// The layers that all views of a rig share, with their channels concatenated.
struct LayerSet {
  std::vector<RowLayer> layers;
  size_t channels = 0;
  std::vector<char> is_nearest;  // per channel: never averaged
  size_t first_nearest = 0;      // index of that channel; the channel count if there is none
  int depth = -1;                // index of the depth channel in metres; negative if there is none
};
LayerSet layers_of(const StoredPicture& picture);
bool same_layers(const LayerSet& a, const LayerSet& b);

class View {
 public:
  // pose: the view's position and direction. Depth, if the view has it and the rig specifies its kind, is converted to
  // depth along rays.
  View(StoredPicture picture, const StereoCamera& pose, ViewDepth depth);
  View(const View&) = delete;
  View& operator=(const View&) = delete;

  // Fills `out` with all channels of the picture's pixels in row y from column `left` on: the filtered hits of their
  // rays, with depth along the rays. Columns wrap around. Returns the number of pixels whose point is occluded in this
  // view; the far background replaces it.
  int fill(const PictureRays& rays, const RowInView& row, int y, int left, std::span<float> out) const;

 private:
  void measure_along_rays(size_t layer);
  void sum_points(const Footprint& footprint, const Place& place, float* out) const;
  void add_pixels(PixelRun& run, const Footprint& footprint, std::span<const vec2> places, float* pixels) const;
  void fill_alike(const RowInView& row, float way, int left, std::span<float> out) const;
  bool fill_pixel(const Ray& ray, const RayInView& seen, const Footprint& footprint, float* out) const;

  StoredPicture picture_;
  LayerSet layers_;
  std::vector<float> distances_;  // replaces the file's depth
  Source source_;
  Resampler resampler_;
  std::optional<Reprojection> surfaces_;
  Camera camera_;
};

}  // namespace ods
