// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What the two eyes of a picture have in common, place by place, and which projection explains it: in the right one
// every place is as high in one eye as in the other, and only moves around.
#pragma once
#include <vector>

#include "ods/base/extent.h"
#include "ods/camera/projection.h"
#include "ods/image/image.h"

namespace ods {

// The same detail in both images; pixels from the left and top edge.
struct PointPair {
  vec2 left{0.0f};
  vec2 right{0.0f};
};

struct PointPairs {
  Extent size;     // of either image
  int places = 0;  // with detail in the first image
  std::vector<PointPair> found;
};

// Two images of equal size, as a display shows them: 1 channel, 0..1.
PointPairs find_pairs(const Image& left, const Image& right);

// How well a projection explains pairs.
struct Parallax {
  int count = 0;       // pairs that move
  double level = 0.0;  // the mean likelihood of their heights, as a logarithm: 0 if all are the same in both eyes
  double order = 0.0;  // from -1, the first image is the right eye's, to 1, it is the left one's; 0: they do not tell
};
Parallax parallax_in(const PointPairs& pairs, const ProjectionSetting& projection);

}  // namespace ods
