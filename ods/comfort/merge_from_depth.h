// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Computes a pole merge from depth: at each elevation the largest share of the eye distance that keeps the vertical
// disparity within a limit. High ceilings and open skies keep full stereo, which a fixed angle would lose.
#pragma once
#include <memory>
#include <vector>

#include "ods/comfort/comfort.h"
#include "ods/picture/stored_picture.h"

namespace ods {

inline constexpr int kMergeRows = 180;  // number of elevations, from the zenith down

// Returns the share of the eye distance for each elevation at which no point of `seen` is above the limit (minutes of
// arc, as worst_vertical_disparity()). 1 if nothing is seen there. Precondition: seen.eye is kMono, the camera is
// level.
std::vector<float> comfortable_shares(const SeenDepth& seen, const Viewer& viewer, float limit);

// Returns the depth of the eyes of a picture: the nearest of each block of pixels. Precondition: the picture has a
// depth layer.
std::vector<SeenDepth> seen_by_eyes(const StoredPicture& picture);

// Returns the shares for the depth that the eyes of a picture show, for the target's eyes.
std::vector<float> comfortable_shares(const std::vector<SeenDepth>& eyes, const StereoCamera& target, float limit);

// Sets each row to the minimum of both.
void min_in_place(std::vector<float>& shares, const std::vector<float>& others);

// Sets the camera to merge both poles by this map.
void use_merge_map(StereoCamera& camera, Image map);

// Returns a StereoCamera::merge_map: at most the shares, never growing towards a pole, and smooth, so that flat things
// do not look bent.
Image merge_map_of(std::vector<float> shares);

inline constexpr double kLookSeconds = 0.25;  // time between the pictures of a video that SteadyMerge uses

// A merge that follows the depth of a video without pumping: at most the shares of all pictures within two seconds
// before and after, smoothed over two more seconds. It changes by at most a quarter of the eye distance per second.
class SteadyMerge {
 public:
  // looks: the shares of the pictures 0, step, 2 * step, ... Preconditions: there is one, step > 0.
  SteadyMerge(const std::vector<std::vector<float>>& looks, int step);

  // The merge map of a picture.
  std::shared_ptr<const Image> at(int picture) const;

  // Return the minimum over time at each elevation, and whether the merge ever exceeds it.
  Image minimum() const;
  bool varies() const;

 private:
  std::vector<Image> maps_;
  int step_;
};

}  // namespace ods
