// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture becomes another: of another projection, size, orientation or convergence, of other eyes. Every pixel looks
// up its line of sight in the picture that there is (source.h), and averages what it covers there (resample.h).
//
// A stereo picture can be turned about its viewing circle's axis, exactly. It cannot be tilted: the circle would lie in
// the old plane, and the lines that the tilted eyes need were never seen. A mono picture can be turned any way.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"

namespace ods {

struct ConvertTarget {
  StereoCamera camera;
  Extent eye;
  std::vector<int> eyes{kLeft, kRight};  // as EyeImage has them
  int mono_from = kLeft;                 // the eye of a stereo picture that a mono one is made of
};

// A picture's own form: what converts it to itself.
ConvertTarget same_format(const StoredPicture& picture);

// A picture's layers as rows of it have them: floats stay floats, all else is halves.
std::vector<RowLayer> row_layers(const StoredPicture& picture);

struct Conversion {
  PictureRows rows;
  bool sees_around = false;  // the eyes stand elsewhere than the picture's
  int64_t no_depth = 0;      // pixels of the picture, both eyes', with a depth that is none: Reprojection
  // Pixels filled so far which the picture had nothing for; all their channels are 0, but for depth,
  // which is kFarDepth.
  std::shared_ptr<std::atomic<int64_t>> empty = std::make_shared<std::atomic<int64_t>>(0);
};

// Why a picture cannot become another, in words for a message; empty: it can.
std::string conversion_fault(const StoredPicture& picture, const ConvertTarget& target);

// The size of an eye as sharp as the picture, in the middle, but not wider than kMaxSide: an even width, whole faces,
// the projection's shape.
Extent fitting_extent(const StoredPicture& picture, const ProjectionSetting& projection);

// The layers are the picture's, and alpha is added to a colour without it where the target sees more than the picture.
// The picture stays where it is until the last row is filled. Precondition: no conversion_fault().
Conversion convert(const StoredPicture& picture, const ConvertTarget& target);

}  // namespace ods
