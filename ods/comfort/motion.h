// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Measures how a video moves its viewer: the motion of a still world between two frames if the camera turns by omega
// and moves by v. A point in the direction u at the distance d moves by -omega x u - (v - (v . u) u) / d; both are
// fitted to the places that two frames have in common, by least squares with the weights of a Cauchy distribution, so
// that moving objects count little.
#pragma once
#include "ods/disparity/gray_view.h"

namespace ods {

// Motion in the camera's frame: x to the right, y up, z backwards.
struct ViewerMotion {
  glm::dvec3 turn{0.0};      // radians a second; y is a turn to the left
  glm::dvec3 velocity{0.0};  // metres a second
  int places = 0;            // the number of places that agree
};

inline constexpr int kMinPlaces = 20;  // minimum of ViewerMotion::places; below it the motion is unknown

// Measures the motion between two views of one eye. depth: the distances in the first (1 channel, lat-long, of any
// width; NaN: unknown). Returns zeros if too few places agree.
ViewerMotion motion_between(const GrayView& before, const GrayView& after, const Image& depth, double seconds);

}  // namespace ods
