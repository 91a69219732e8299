// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Judges the strain of the viewer's eyes by a scene before it is rendered, by rays through the centres of the pixels.
#pragma once
#include <vector>

#include "ods/comfort/judge_picture.h"
#include "ods/comfort/merge_from_depth.h"
#include "ods/render/renderer.h"
#include "ods/scene/scene.h"

namespace ods {

// Judges both eyes of a picture of this width, in the scene's present state. The picture's radiance encodes distances
// as grey. The scene must be the renderer's, at the same time. For the verdict of `ods comfort`, place the camera with
// camera_in() (ods/sequence/scene_camera.h) and merge both poles by kUsualMerge. Throws Error(kInput) as
// judge_comfort(). Precondition: width > 0.
JudgedPicture judge_scene(const Renderer& renderer, const Scene& scene, const StereoCamera& camera, int width = 512,
                          const ComfortOptions& options = {});

// Returns comfortable_shares() of the scene from the camera's position: the stereo that it allows at each elevation.
std::vector<float> shares_seen(const Renderer& renderer, const StereoCamera& camera, float limit);

}  // namespace ods
