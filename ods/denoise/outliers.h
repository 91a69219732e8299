// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Fireflies: pixels that one rare sample made far brighter than everything around them. A window of few pixels shows
// their light as a blotch, so they are removed before the passes, and their light is spread widely afterwards. No light
// is lost.
#pragma once
#include <vector>

#include "ods/denoise/noisy_picture.h"

namespace ods {

struct Outlier {
  int eye = 0;  // index in Picture::eyes
  int x = 0;
  int y = 0;
  vec3 excess{0.0f};  // radiance
};

// Gives fireflies the light and the variance of the pixels around them, and returns the excess, in the order of eyes,
// rows and columns. A bright pixel whose own variance confirms its brightness is not a firefly.
std::vector<Outlier> take_outliers(const NoisyPicture& noisy, std::vector<Level>& levels);

// Adds the outliers' light to the pixels around them, in larger areas for brighter ones, so that it is nearly
// invisible. The part that would still be visible brightens the whole picture slightly. both: half of the light goes to
// the place in the other eye that shows the same surface; needs depth.
void spread_outliers(const NoisyPicture& noisy, const std::vector<Outlier>& outliers, bool both,
                     std::vector<Level>& levels);

}  // namespace ods
