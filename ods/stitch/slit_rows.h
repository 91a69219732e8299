// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the rays of a picture lie in the views of its rig.
#pragma once
#include <vector>

#include "ods/base/parabola.h"
#include "ods/stitch/slit_rig.h"

namespace ods {

// The rays of one eye of the picture that is put together.
struct PictureRays {
  Camera camera;
  int eye = kMono;
  vec2 size{1.0f};  // pixels

  // Places in pixels from the left and top edge; the middle of the first is 0.5.
  Ray at(float x, float y) const { return camera_ray(camera, eye, vec2(x, y) / size); }
  // The way to the next row that is further from the picture's nearer edge: 1 or -1.
  float way(float y) const { return 2.0f * y < size.y ? 1.0f : -1.0f; }
};

// A ray of the picture in a view, and the one beside it a pixel on the way(), as places in the view's pixels.
struct RayInView {
  vec2 at{0.0f};
  vec2 beside{0.0f};
  float nearer = 0.0f;  // metres by which the view stands nearer than the ray's origin to what it meets
};
RayInView ray_in_view(const Camera& view, Extent size, const PictureRays& rays, float x, float y);

// A row of a slit: its left end, middle and right end. Rays between them lie on the parabola.
struct RowInView {
  RayInView rays[3];
  float middle = 0.0f;  // column
  float reach = 0.0f;   // columns from there to either end
};

// That of a place along the row, by the parabola.
inline RayInView ray_along(const RowInView& row, float x) {
  const float t = (x - row.middle) / row.reach + 1.0f;
  const RayInView &a = row.rays[0], &b = row.rays[1], &c = row.rays[2];
  return {on_parabola(a.at, b.at, c.at, t), on_parabola(a.beside, b.beside, c.beside, t),
          on_parabola(a.nearer, b.nearer, c.nearer, t)};
}

// The rows of all slits of an eye. Views that stand to their slits as those of the first slit do, which all are that
// nobody has moved, share them.
class SlitRows {
 public:
  // The rig stays where it is.
  SlitRows(const SlitRig& rig, size_t eye);

  const PictureRays& rays() const { return rays_; }

  // `place`: the slit's along the picture, whose last slit's neighbour is the first.
  RowInView row(int place, int slit, int pitch, int y) const;

 private:
  float middle_of(int place) const;
  RowInView find_row(const Camera& view, int place, int y) const;
  bool is_alike(int slit, int pitch) const;
  const Camera& camera_of(int slit, int pitch) const { return cameras_[view_index(rig_, 0, slit, pitch)]; }

  const SlitRig& rig_;
  PictureRays rays_;
  float reach_;
  std::vector<Camera> cameras_;  // of every slit's pitches
  std::vector<char> alike_;
  std::vector<RowInView> rows_;  // of the first slit's pitches
};

}  // namespace ods
