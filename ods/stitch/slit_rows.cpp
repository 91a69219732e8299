// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stitch/slit_rows.h"

#include <algorithm>
#include <cmath>

namespace ods {

static vec2 place_in(const Camera& view, Extent size, vec3 direction) {
  const vec3 d(dot(direction, view.right), dot(direction, view.up), dot(direction, view.back));
  return perspective_place(view.projection, d).uv * vec2(size.width, size.height);
}

// Inlining the kernel's camera makes it faster.
[[gnu::flatten]] RayInView ray_in_view(const Camera& view, Extent size, const PictureRays& rays, float x, float y) {
  const Ray ray = rays.at(x, y), beside = rays.at(x, y + rays.way(y));
  return {place_in(view, size, ray.direction), place_in(view, size, beside.direction),
          dot(view.center - ray.origin, ray.direction)};
}

SlitRows::SlitRows(const SlitRig& rig, size_t eye)
    : rig_(rig),
      rays_{make_camera(rig.camera), rig.eyes[eye], {rig.eye.width, rig.eye.height}},
      reach_(0.5f * (1.0f + rig.options.blend) * static_cast<float>(rig.eye.width) /
             static_cast<float>(rig.options.slits)) {
  for (int slit = 0; slit < rig.options.slits; slit++) {
    for (int pitch = 0; pitch < rig.options.pitches; pitch++) {
      cameras_.push_back(make_camera(rig.views[view_index(rig, eye, slit, pitch)]));
    }
  }
  for (int pitch = 0; pitch < rig.options.pitches; pitch++) {
    for (int y = 0; y < rig.eye.height; y++) rows_.push_back(find_row(camera_of(0, pitch), 0, y));
  }
  for (int slit = 0; slit < rig.options.slits; slit++) {
    for (int pitch = 0; pitch < rig.options.pitches; pitch++) alike_.push_back(is_alike(slit, pitch) ? 1 : 0);
  }
}

float SlitRows::middle_of(int place) const {
  return static_cast<float>((place + 0.5) * rig_.eye.width / rig_.options.slits);
}

RowInView SlitRows::find_row(const Camera& view, int place, int y) const {
  const float middle = middle_of(place), py = static_cast<float>(y) + 0.5f;
  const auto at = [&](float x) { return ray_in_view(view, rig_.view, rays_, x, py); };
  return {{at(middle - reach_), at(middle), at(middle + reach_)}, middle, reach_};
}

// Checked where they would differ most: at the ends and in the middle of the view's part.
bool SlitRows::is_alike(int slit, int pitch) const {
  constexpr float kSame = 1.0f / 256.0f;  // pixels of a view: covers the rounding of angles, but no more
  const float top = pitch_border(rig_, -1), bottom = pitch_border(rig_, rig_.options.pitches - 1);
  const auto row_below = [&](int border) {
    return std::lround(static_cast<float>(rig_.eye.height) * (top - pitch_border(rig_, border)) / (top - bottom));
  };
  const int first = static_cast<int>(row_below(pitch - 1)), last = static_cast<int>(row_below(pitch)) - 1;
  for (const int y : {first, (first + last) / 2, last}) {
    const RowInView own = find_row(camera_of(slit, pitch), slit, y);
    const RowInView& others = rows_[static_cast<size_t>(pitch * rig_.eye.height + y)];
    for (size_t i = 0; i < 3; i++) {
      if (!(length(own.rays[i].at - others.rays[i].at) < kSame)) return false;
    }
  }
  return true;
}

RowInView SlitRows::row(int place, int slit, int pitch, int y) const {
  if (!alike_[view_index(rig_, 0, slit, pitch)]) return find_row(camera_of(slit, pitch), place, y);
  RowInView row = rows_[static_cast<size_t>(pitch * rig_.eye.height + y)];
  row.middle = middle_of(place);
  return row;
}

}  // namespace ods
