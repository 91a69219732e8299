// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Judges a scene for its viewer's eyes before it is rendered, by the rays through the centres of the pixels.
#pragma once
#include <vector>

#include "ods/comfort/judge_picture.h"
#include "ods/comfort/merge_from_depth.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/scene.h"

namespace ods {

// Judges both eyes of a picture this wide, of the scene as the renderer has it. Its light shows the distances.
JudgedPicture judge_scene(const CpuRenderer& renderer, const Scene& scene, const StereoCamera& camera, int width = 512,
                          const ComfortOptions& options = {});

// The stereo that the scene allows at each elevation, seen from the camera's place: comfortable_shares().
std::vector<float> shares_seen(const CpuRenderer& renderer, const StereoCamera& camera, float limit);

}  // namespace ods
