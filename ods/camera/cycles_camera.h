// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The stereo camera of Blender's Cycles (spherical_stereo_transform() in its src/kernel/camera/projection.h), and which
// of our cameras it can be.
#pragma once
#include <string>
#include <vector>

#include "ods/camera/stereo_camera.h"

namespace ods {

// The reason why Cycles' eyes cannot be at the camera's, for messages. Empty if they can in every row: without a neck,
// with a merge that is the same all around. Names in backticks are options.
std::string cycles_lacks(const StereoCamera& camera);

// Returns whether Cycles itself renders the camera's projection: lat-long, whole or a part. Its other projections have
// limits of their own.
bool cycles_projects(const ProjectionSetting& projection);

// Rows of a lat-long that Cycles renders at once.
struct CyclesBand {
  int first = 0, rows = 0;
  StereoCamera camera;  // of these rows alone, with a merge that Cycles has
};

// Returns the bands of a picture of this height, from the top: one if Cycles has the camera's merge, which is a plain
// cosine at both poles or none. Otherwise each has eyes at a distance of its own, without a merge: of a point 1 m away
// they are off by a quarter of a pixel at most, unless the merge is so steep that kLeastBand rows change it by more.
// Precondition: cycles_projects(), cycles_lacks() is empty.
inline constexpr int kLeastBand = 4;  // rows, of a picture in Blender
std::vector<CyclesBand> cycles_bands(const StereoCamera& camera, int height);

// The whole lat-long with the camera's eyes. Other projections are made from it (ods/convert/convert.h).
StereoCamera lat_long_of(StereoCamera camera);

}  // namespace ods
