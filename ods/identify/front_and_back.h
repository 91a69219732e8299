// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Aligns two fisheyes that look ahead and back: their field of view, by what both see beside the camera and by what
// only one of them sees, their roll, and the direction of the second one.
#pragma once
#include <optional>
#include <vector>

#include "ods/camera/direction_map.h"
#include "ods/image/image.h"

namespace ods {

// The images of two lenses of equal size, as a display shows them: 1 channel, 0..1.
struct LensImages {
  const Image& first;
  const Image& second;
};

// The source of the field of view of two lenses.
enum class FovSource {
  kTold,     // specified by the caller
  kOverlap,  // both lenses see the same beside them
  kRims,     // nothing is seen twice, but the picture of one lens continues in that of the other: 180 degrees
  kNothing,  // the pictures are too smooth there to tell; the usual angle
};

struct OppositeLenses {
  std::vector<FisheyeLens> lenses;  // the second one looks back (its yaw is 0 all the same, as in FormatHint)
  FovSource source = FovSource::kNothing;
  float alike = -1.0f;  // correlation of what both see, or of both rims, -1..1
};

// Aligns lenses whose circles are known. coarse: lens_detail() of both images with kCoarseDetail. fov: degrees, measured
// if not set. Most cameras store the upper side up; if not, light comes from there.
OppositeLenses align_front_and_back(const LensImages& images, const LensImages& coarse,
                                    const std::vector<FisheyeLens>& lenses, std::optional<float> fov);

}  // namespace ods
