// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Judges the strain of the viewer's eyes by a scene before it is rendered, by rays through the centres of the pixels.
#pragma once
#include <vector>

#include "ods/comfort/judge_picture.h"
#include "ods/comfort/merge_from_depth.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/scene.h"

namespace ods {

// Judges both eyes of a picture this wide, of the scene as the renderer has it. The picture's light shows the distances
// as grey.
JudgedPicture judge_scene(const CpuRenderer& renderer, const Scene& scene, const StereoCamera& camera, int width = 512,
                          const ComfortOptions& options = {});

// Returns comfortable_shares() of the scene from the camera's position: the stereo that it allows at each elevation.
std::vector<float> shares_seen(const CpuRenderer& renderer, const StereoCamera& camera, float limit);

}  // namespace ods
