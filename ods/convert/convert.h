// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Converts a picture to another projection, size, orientation or convergence, or to other eyes. Every target pixel
// looks up its line of sight in the source picture (panorama.h) and averages the texels that it covers there
// (resample.h).
//
// A stereo picture can be turned about its viewing circle's axis, exactly. It cannot be tilted: the circle would remain
// in the old plane, and the picture does not contain the lines that the tilted eyes need. A mono picture can be turned
// any way.
//
// convert() returns rows that are computed when they are written: save_picture() calls rows.fill from several threads.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ods/base/names.h"
#include "ods/camera/eye_correction.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"

namespace ods {

// What becomes of pixels that show what no eye of the picture sees, where eyes are moved.
enum class Holes { kEmpty, kFilled };
inline constexpr NameRow<Holes> kHolesTable[] = {
    {Holes::kEmpty, "empty"}, {Holes::kFilled, "filled"},  // from what is behind, never from what is before it
};
static_assert(has_every_member(kHolesTable));

struct ConvertTarget {
  StereoCamera camera;
  Extent eye;
  std::vector<int> eyes{kLeft, kRight};  // as in EyeImage
  int mono_from = kLeft;                 // the eye of a stereo picture from which a mono one is made
  EyeCorrection right{};                 // of the picture's right eye
  Holes holes = Holes::kEmpty;
  // How the picture's camera was turned when the picture was taken, beyond what `camera` of the picture says: degrees,
  // in the camera's own frame. Each eye's picture is turned back as a whole, which is exact for what is far away.
  ViewAngles turned{0.0f, 0.0f, 0.0f};
};

// The target that leaves a picture unchanged; of one that is stored by maps, the lat-long that shows as much.
ConvertTarget same_format(const StoredPicture& picture);

// Whether every target pixel is the picture's own at the same place. Never of a projection with an image circle, whose
// edge is made anew.
bool is_same_picture(const StoredPicture& picture, const ConvertTarget& target);

// A picture's layers as its rows have them: float layers remain float, all others become half.
std::vector<RowLayer> row_layers(const StoredPicture& picture);

struct Conversion {
  PictureRows rows;
  bool sees_around = false;  // the target's eyes are in other places than the picture's
  int64_t no_depth = 0;      // pixels of the picture, of both eyes, without a valid depth: Reprojection
  // Target pixels filled so far for which the picture has nothing. All their channels are 0, except depth,
  // which is kFarDepth.
  std::shared_ptr<std::atomic<int64_t>> empty = std::make_shared<std::atomic<int64_t>>(0);
  std::shared_ptr<std::atomic<int64_t>> filled = std::make_shared<std::atomic<int64_t>>(0);  // Holes::kFilled
};

// Why a picture cannot be converted, in words for a message; empty: it can.
std::string conversion_fault(const StoredPicture& picture, const ConvertTarget& target);

// The eye size that keeps the source's resolution at the centre, at most kMaxSide wide. Width and height are even,
// cubes have whole faces, and the shape is the projection's.
Extent fitting_extent(const StoredPicture& picture, const ProjectionSetting& projection);

// The target has the picture's layers. A colour without alpha gets alpha if the target sees more than the picture.
// The picture must not move or go away before the last row is filled. Precondition: conversion_fault() is empty.
Conversion convert(const StoredPicture& picture, const ConvertTarget& target);

}  // namespace ods
