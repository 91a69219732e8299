// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A rendered view of a rig of slits, looked into along rays of the picture that is put together.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "ods/convert/reproject.h"
#include "ods/convert/resample.h"
#include "ods/picture/save.h"
#include "ods/stitch/slit_rows.h"

namespace ods {

// What all views of a rig have: their layers, channel behind channel.
struct LayerSet {
  std::vector<RowLayer> layers;
  size_t channels = 0;
  std::vector<char> is_nearest;  // of every channel: never averaged
  size_t first_nearest = 0;      // that channel; all, if none is
  int depth = -1;                // the channel of metres; below 0: there is none
};
LayerSet layers_of(const StoredPicture& picture);
bool same_layers(const LayerSet& a, const LayerSet& b);

class View {
 public:
  // `pose`: where it stood and looked. Its depth, if it has any and the rig says which, becomes that along its rays.
  View(StoredPicture picture, const StereoCamera& pose, ViewDepth depth);
  View(const View&) = delete;
  View& operator=(const View&) = delete;

  // All channels of the picture's pixels in row y from column `left` on, as many as `out` has room for: what their rays
  // meet, averaged over them; depth is along their rays. Columns beyond the last one go on at the first. Returns the
  // number of those that the view does not show what their ray meets; what is far behind stands in.
  int fill(const PictureRays& rays, const RowInView& row, int y, int left, std::span<float> out) const;

 private:
  void measure_along_rays(size_t layer);
  void sum_points(const Footprint& footprint, const Place& place, float* out) const;
  void add_pixels(PixelRun& run, const Footprint& footprint, std::span<const vec2> places, float* pixels) const;
  void fill_alike(const RowInView& row, float way, int left, std::span<float> out) const;
  bool fill_pixel(const Ray& ray, const RayInView& seen, const Footprint& footprint, float* out) const;

  StoredPicture picture_;
  LayerSet layers_;
  std::vector<float> distances_;  // in place of the depth that the file has
  Source source_;
  Resampler resampler_;
  std::optional<Reprojection> surfaces_;
  Camera camera_;
};

}  // namespace ods
