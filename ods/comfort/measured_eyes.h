// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How a picture's eyes were placed, measured where no word of it tells: other renderers' pictures with depth, whose
// pole merge, convergence and eye distance nobody wrote down. Depth says how far a point is, the eyes how far apart
// they show it; their ratio at each elevation is the circle on which the eyes stood.
#pragma once
#include <optional>
#include <vector>

#include "ods/comfort/comfort.h"

namespace ods {

struct MeasuredEyes {
  StereoCamera camera;    // its eye distance, convergence and pole merge as measured; without a merge: kMergeNone
  double error = 0.0;     // of the merge's shares: how far elevations mostly are from the curve, 0..1
  double up = 0.0;        // degrees: the curve was measured so far up and down, and goes on straight from there
  double down = 0.0;      // positive
  bool is_known = false;  // whether it is merged: far enough up or down was measured, and its eyes do not converge
  bool is_merged = false;
};

// eyes: as grey_eyes() returns them. seen: the left eye, with the camera as far as it is known. Nothing if the eyes do
// not match, or what matches is too little or too far away to tell.
std::optional<MeasuredEyes> measure_eyes(const std::vector<Image>& eyes, const SeenDepth& seen, bool is_float);

}  // namespace ods
