// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Computes how much stereo a scene allows at each elevation (ods/comfort/merge_from_depth.h).
#pragma once
#include <vector>

#include "ods/camera/stereo_camera.h"
#include "ods/comfort/merge_from_depth.h"
#include "ods/render/cpu/render.h"

namespace ods {

// comfortable_shares() for the depth seen from the camera's position, in the renderer's scene.
std::vector<float> shares_seen(const CpuRenderer& renderer, const StereoCamera& camera, float limit);

}  // namespace ods
