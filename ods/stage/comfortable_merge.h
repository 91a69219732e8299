// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How much stereo a scene allows at each elevation (ods/comfort/merge_from_depth.h).
#pragma once
#include <vector>

#include "ods/camera/stereo_camera.h"
#include "ods/comfort/merge_from_depth.h"
#include "ods/render/cpu/render.h"

namespace ods {

// comfortable_shares() of what is seen from the camera's place, in the scene as the renderer has it.
std::vector<float> shares_seen(const CpuRenderer& renderer, const StereoCamera& camera, float limit);

}  // namespace ods
