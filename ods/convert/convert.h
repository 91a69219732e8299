// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Converts a picture to another projection, size, orientation or convergence, or to other eyes. Every target pixel
// looks up its line of sight in the source picture (panorama.h) and averages the texels that it covers there
// (resample.h).
//
// A stereo picture can be turned about its viewing circle's axis, exactly. It cannot be tilted: the circle would remain
// in the old plane, and the picture does not contain the lines of sight of the tilted eyes. A mono picture can be
// turned in any direction.
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

// The treatment of pixels that no source eye sees (disocclusions).
enum class Holes { kEmpty, kFilled };
inline constexpr NameRow<Holes> kHolesTable[] = {
    {Holes::kEmpty, "empty"}, {Holes::kFilled, "filled"},  // from the background, never from the object in front of it
};
static_assert(has_every_member(kHolesTable));

// The picture to make. The eyes of the source are first corrected (`right`), then turned back (`turned`), and then
// seen by `camera`.
struct ConvertTarget {
  StereoCamera camera;
  Extent eye;
  std::vector<int> eyes{kLeft, kRight};  // as in EyeImage
  int mono_from = kLeft;                 // the eye of a stereo picture from which a mono picture is made
  EyeCorrection right{};                 // correction of the picture's right eye
  Holes holes = Holes::kEmpty;
  // The rotation of the camera when the picture was taken, in addition to the picture's `camera`: degrees, in the
  // camera's own frame. Each eye's picture is turned back as a whole, which is exact for distant points.
  ViewAngles turned{0.0f, 0.0f, 0.0f};
};

// The target that leaves a picture unchanged. For a picture stored with maps, the lat-long that covers the same
// directions.
ConvertTarget same_format(const StoredPicture& picture);

// Returns whether every target pixel is the picture's own at the same place. Always false for a projection with an
// image circle, whose edge is made again.
bool is_same_picture(const StoredPicture& picture, const ConvertTarget& target);

// A picture's layers in the form of its rows: float layers remain float, all others become half.
std::vector<RowLayer> row_layers(const StoredPicture& picture);

struct Conversion {
  PictureRows rows;
  bool sees_around = false;  // the target's eyes are at other positions than the picture's
  int64_t no_depth = 0;      // pixels of the picture, of both eyes, without a valid depth: Reprojection
  // Number of target pixels filled so far that are empty in the picture. All their channels are 0, except depth, which
  // is kFarDepth.
  std::shared_ptr<std::atomic<int64_t>> empty = std::make_shared<std::atomic<int64_t>>(0);
  std::shared_ptr<std::atomic<int64_t>> filled = std::make_shared<std::atomic<int64_t>>(0);  // Holes::kFilled
};

// The reason why a picture cannot be converted, for messages. Empty if it can.
std::string conversion_fault(const StoredPicture& picture, const ConvertTarget& target);

// The eye size that keeps the source's resolution at the centre, at most kMaxSide wide. Width and height are even,
// cubes have whole faces, and the aspect ratio is the projection's.
Extent fitting_extent(const StoredPicture& picture, const ProjectionSetting& projection);

// Converts a picture. The target has the picture's layers. A colour without alpha gets alpha if the target covers more
// directions than the picture. The picture must not move or be destroyed before the last row is filled. Precondition:
// conversion_fault() is empty.
Conversion convert(const StoredPicture& picture, const ConvertTarget& target);

}  // namespace ods
