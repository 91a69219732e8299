// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The stereo camera of Blender's Cycles (spherical_stereo_transform() in its src/kernel/camera/projection.h), and which
// of our cameras it can be.
#pragma once
#include <string>

#include "ods/base/extent.h"
#include "ods/camera/stereo_camera.h"

namespace ods {

// The reason why Cycles' eyes cannot be at the camera's, for messages. Empty if they can, for every direction; they can
// for one plain cosine at both poles, without a neck. Names in backticks are options.
std::string cycles_lacks(const StereoCamera& camera);

// Returns whether Cycles itself renders the camera's projection: lat-long, whole or a part. Its other projections have
// limits of their own.
bool cycles_projects(const ProjectionSetting& projection);

// The whole lat-long with the camera's eyes. Other projections are made from it (ods/convert/convert.h).
StereoCamera lat_long_of(StereoCamera camera);

}  // namespace ods
