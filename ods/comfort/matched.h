// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Judges pictures without depth by matching their eyes: the parallax of a thing is the angle by which eyes must
// converge.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "ods/comfort/verdict.h"
#include "ods/disparity/gray_view.h"

namespace ods {

inline constexpr int kMatchedWidth = 1024;  // width of the matched views: 21 minutes of arc per pixel

// Throws Error(kInput) if an eye this wide has too few pixels to be matched. name: the file's name, for messages.
void check_matchable(const ProjectionSetting& projection, int width, const std::string& name);

// Both eyes as small views at equal height.
struct AlignedEyes {
  std::vector<GrayView> views;
  double apart = 0.0;            // as MatchQuality::apart
  bool are_one_picture = false;  // enough of one eye is in the other
};
AlignedEyes align_eyes(const std::vector<Image>& eyes, const ProjectionSetting& projection, bool is_float,
                       int width = kMatchedWidth);

inline constexpr double kMinMatched = 0.02;  // the smallest MatchQuality::share that is judged

// The eyes after matching. The vertical misalignment, MatchQuality::apart, is removed before.
struct MatchedEyes : MatchQuality {
  std::vector<SeenDepth> seen;  // left and right eye: lat-long; unknown where nothing could be matched
  std::vector<Image> grey;      // the views
};

// eyes: left and right, as grey_eyes() returns them. The camera describes how they were taken; if the picture does not
// record its eye distance, distances assume the camera's. Eyes that show different things are not matched.
MatchedEyes match_eyes_for_depth(const std::vector<Image>& eyes, const StereoCamera& camera, bool is_float,
                                 int width = kMatchedWidth);

// Matches views of the eyes, as make_gray_views() makes them, of eyes at equal height: `apart` is 0.
MatchedEyes match_views_for_depth(std::vector<GrayView> views, const StereoCamera& camera);

// Returns the distance along an eye's ray of a point whose azimuth is `around` farther right in the left eye's picture
// than in the right one's. kFarDepth: beyond everything. uv: the point in the eye's picture. The inverse of
// half_parallax_of().
float depth_of_parallax(const Camera& camera, int eye, vec2 uv, float around);

}  // namespace ods
