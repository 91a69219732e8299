// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Estimates the placement of a picture's eyes if its metadata do not record it: pictures with depth by other renderers
// do not record pole merge, convergence and eye distance. Depth is the distance of a point, the two eyes show its
// parallax; at each elevation, their ratio is the radius of the circle of the eyes.
#pragma once
#include <optional>
#include <vector>

#include "ods/comfort/comfort.h"

namespace ods {

struct MeasuredEyes {
  StereoCamera camera;    // its eye distance, convergence and pole merge as measured; without a merge: kMergeNone
  double error = 0.0;     // typical deviation of an elevation's share from the curve, 0..1
  double up = 0.0;        // limits of the measured curve, degrees up and down; straight beyond
  double down = 0.0;      // positive
  bool is_known = false;  // the merge is known: it was measured far enough up or down, and the eyes do not converge
  bool is_merged = false;
};

// eyes: as grey_eyes() returns them. seen: the left eye, with the camera as far as it is known. Returns nullopt if the
// eyes do not match, or if too little matches, or only things that are too far away.
std::optional<MeasuredEyes> measure_eyes(const std::vector<Image>& eyes, const SeenDepth& seen, bool is_float);

}  // namespace ods
