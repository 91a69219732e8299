// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A pole merge that follows from depth: at each elevation as much of the eye distance as keeps the vertical disparity
// within a limit. High ceilings and open skies keep full stereo, where a fixed angle would throw it away.
#pragma once
#include <vector>

#include "ods/comfort/comfort.h"

namespace ods {

inline constexpr int kMergeRows = 180;  // of elevations, from the zenith down

// The share of the eye distance for each elevation with which no point of `seen` is above the limit (minutes of arc, as
// worst_vertical_disparity()). Where nothing is seen: 1. Precondition: seen.eye is kMono, the camera is level.
std::vector<float> comfortable_shares(const SeenDepth& seen, const Viewer& viewer, float limit);

// The least of both, row by row.
void take_least(std::vector<float>& shares, const std::vector<float>& others);

// Merges both poles by this map.
void use_merge_map(StereoCamera& camera, Image map);

// For StereoCamera::merge_map: no more than the shares, never growing towards a pole, and smooth: what is flat is not
// seen to bend.
Image merge_map_of(std::vector<float> shares);

}  // namespace ods
