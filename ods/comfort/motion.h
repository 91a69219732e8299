// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How a video carries its viewer: what a still world does between two frames if the camera turns by omega and moves by
// v. A point in the direction u at the distance d moves by -omega x u - (v - (v . u) u) / d; both are fitted to the
// places that two frames have in common, by least squares with the weights of a Cauchy distribution: what moves by
// itself counts little.
#pragma once
#include "ods/disparity/gray_view.h"

namespace ods {

// In the camera's frame: x to the right, y up, z backwards.
struct ViewerMotion {
  glm::dvec3 turn{0.0};      // radians a second; y is a turn to the left
  glm::dvec3 velocity{0.0};  // metres a second
  int places = 0;            // that agree
};

inline constexpr int kMinPlaces = 20;  // of ViewerMotion::places; with fewer, the motion is unknown

// Two views of one eye and the distances that the first shows (1 channel, lat-long, of any width; NaN: unknown).
// Without enough places it is all 0.
ViewerMotion motion_between(const GrayView& before, const GrayView& after, const Image& depth, double seconds);

}  // namespace ods
