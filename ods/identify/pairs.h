// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Matching places in the two eyes of a picture, and the projection that explains them: in the right one every place is
// at the same elevation in both eyes, and only moves around.
#pragma once
#include <vector>

#include "ods/base/extent.h"
#include "ods/camera/projection.h"
#include "ods/image/image.h"

namespace ods {

// The position of the same detail in both images, pixels from the left and top edge.
struct PointPair {
  vec2 left{0.0f};
  vec2 right{0.0f};
};

struct PointPairs {
  Extent size;     // size of each image
  int places = 0;  // number of places with detail in the first image
  std::vector<PointPair> found;
};

// Matches two images of equal size, as a display shows them: 1 channel, 0..1.
PointPairs find_pairs(const Image& left, const Image& right);

// The fit of a projection to the pairs.
struct Parallax {
  int count = 0;       // pairs with parallax
  double level = 0.0;  // the mean logarithm of the likelihood of their heights; 0 if all are equal in both eyes
  double order = 0.0;  // from -1 (the first image is the right eye's) to 1 (the left eye's); 0 if undecided
};
Parallax parallax_in(const PointPairs& pairs, const ProjectionSetting& projection);

}  // namespace ods
