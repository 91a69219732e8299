// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A pole merge that follows from depth: at each elevation as much of the eye distance as keeps the vertical disparity
// within a limit. High ceilings and open skies keep full stereo, where a fixed angle would throw it away.
#pragma once
#include <memory>
#include <vector>

#include "ods/comfort/comfort.h"
#include "ods/picture/stored_picture.h"

namespace ods {

inline constexpr int kMergeRows = 180;  // of elevations, from the zenith down

// The share of the eye distance for each elevation with which no point of `seen` is above the limit (minutes of arc, as
// worst_vertical_disparity()). Where nothing is seen: 1. Precondition: seen.eye is kMono, the camera is level.
std::vector<float> comfortable_shares(const SeenDepth& seen, const Viewer& viewer, float limit);

// What the eyes of a picture show: the nearest of blocks of its pixels. Precondition: it has a layer of depth.
std::vector<SeenDepth> seen_by_eyes(const StoredPicture& picture);

// The shares by what the eyes of a picture show, for eyes as the target has them.
std::vector<float> comfortable_shares(const std::vector<SeenDepth>& eyes, const StereoCamera& target, float limit);

// The least of both, row by row.
void take_least(std::vector<float>& shares, const std::vector<float>& others);

// Merges both poles by this map.
void use_merge_map(StereoCamera& camera, Image map);

// For StereoCamera::merge_map: no more than the shares, never growing towards a pole, and smooth: what is flat is not
// seen to bend.
Image merge_map_of(std::vector<float> shares);

inline constexpr double kLookSeconds = 0.25;  // between the pictures of a video that SteadyMerge is made of

// A merge that follows the depth of a video, and never pumps: no more than what is allowed within two seconds before
// and after, and even over two more. In a second it changes by no more than a quarter of the eye distance.
class SteadyMerge {
 public:
  // looks: the shares of the pictures 0, step, 2 * step, ... Preconditions: there is one, step > 0.
  SteadyMerge(const std::vector<std::vector<float>>& looks, int step);

  // The merge map of a picture.
  std::shared_ptr<const Image> at(int picture) const;

  // The least of all at each elevation, and whether there is ever more.
  Image least() const;
  bool varies() const;

 private:
  std::vector<Image> maps_;
  int step_;
};

}  // namespace ods
