// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures without depth, judged by what their eyes have in common: how far things are apart in the two tells how eyes
// must converge.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "ods/comfort/verdict.h"
#include "ods/disparity/gray_view.h"

namespace ods {

inline constexpr int kMatchedWidth = 1024;  // of the views that are matched: 21 minutes of arc a pixel

// Throws Error(kInput) if an eye this wide has too few pixels to be matched. name: of the file.
void check_matchable(const ProjectionSetting& projection, int width, const std::string& name);

// Both eyes as small views that are as high as each other.
struct AlignedEyes {
  std::vector<GrayView> views;
  double apart = 0.0;            // as MatchQuality::apart
  bool are_one_picture = false;  // enough of one eye is in the other
};
AlignedEyes align_eyes(const std::vector<Image>& eyes, const ProjectionSetting& projection, bool is_float,
                       int width = kMatchedWidth);

inline constexpr double kMinMatched = 0.02;  // MatchQuality::share: with less, nothing is judged

// What holds one eye higher than the other, MatchQuality::apart, is taken out before the eyes are matched.
struct MatchedEyes : MatchQuality {
  std::vector<SeenDepth> seen;  // of the left and the right eye: lat-long; unknown where nothing could be matched
  std::vector<Image> grey;      // the views
};

// eyes: left and right, as grey_eyes() returns them. The camera says how they were seen; where the picture does not
// tell its eye distance, distances are as if it were the camera's. Of eyes that do not show the same nothing is
// matched.
MatchedEyes match_eyes_for_depth(const std::vector<Image>& eyes, const StereoCamera& camera, bool is_float,
                                 int width = kMatchedWidth);

// The same for views of theirs, as make_gray_views() makes them, of eyes that are as high as each other: `apart` is 0.
MatchedEyes match_views_for_depth(std::vector<GrayView> views, const StereoCamera& camera);

// How far along its ray an eye shows a point whose azimuth is `around` farther right in the left eye's picture than in
// the right one's. kFarDepth: beyond everything. uv: where the eye shows it. The inverse of half_parallax_of().
float depth_of_parallax(const Camera& camera, int eye, vec2 uv, float around);

}  // namespace ods
