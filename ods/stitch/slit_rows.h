// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Maps the rays of a picture to pixels in the views of its rig.
#pragma once
#include <vector>

#include "ods/base/parabola.h"
#include "ods/stitch/slit_rig.h"

namespace ods {

// The rays of one eye of the stitched picture.
struct PictureRays {
  Camera camera;
  int eye = kMono;
  vec2 size{1.0f};  // pixels

  // Positions in pixels from the top left corner; the centre of the first pixel is 0.5.
  Ray at(float x, float y) const { return camera_ray(camera, eye, vec2(x, y) / size); }
  // The direction to the next row away from the picture's nearer edge: 1 or -1.
  float way(float y) const { return 2.0f * y < size.y ? 1.0f : -1.0f; }
};

// A ray of the picture in a view, and the ray one pixel along way(), as positions in the view's pixels.
struct RayInView {
  vec2 at{0.0f};
  vec2 beside{0.0f};
  float nearer = 0.0f;  // metres by which the view is closer than the ray's origin to the hit point
};
RayInView ray_in_view(const Camera& view, Extent size, const PictureRays& rays, float x, float y);

// A row of a slit: its left end, centre and right end. Rays between them are interpolated by a parabola.
struct RowInView {
  RayInView rays[3];
  float middle = 0.0f;  // column
  float reach = 0.0f;   // columns from the centre to either end
};

// Interpolates the row's parabola at column x.
inline RayInView ray_along(const RowInView& row, float x) {
  const float t = (x - row.middle) / row.reach + 1.0f;
  const RayInView &a = row.rays[0], &b = row.rays[1], &c = row.rays[2];
  return {on_parabola(a.at, b.at, c.at, t), on_parabola(a.beside, b.beside, c.beside, t),
          on_parabola(a.nearer, b.nearer, c.nearer, t)};
}

// The rows of all slits of an eye. Views with the same pose relative to their slit as in the first slit share rows;
// unless the rig was edited, these are all views.
class SlitRows {
 public:
  // The rig must outlive this object.
  SlitRows(const SlitRig& rig, size_t eye);

  const PictureRays& rays() const { return rays_; }

  // place: the slit's index along the picture, before wrapping around.
  RowInView row(int place, int slit, int pitch, int y) const;

 private:
  float middle_of(int place) const;
  RowInView find_row(const Camera& view, int place, int y) const;
  bool is_alike(int slit, int pitch) const;
  const Camera& camera_of(int slit, int pitch) const { return cameras_[view_index(rig_, 0, slit, pitch)]; }

  const SlitRig& rig_;
  PictureRays rays_;
  float reach_;
  std::vector<Camera> cameras_;  // per slit and pitch
  std::vector<char> alike_;
  std::vector<RowInView> rows_;  // per pitch of the first slit
};

}  // namespace ods
