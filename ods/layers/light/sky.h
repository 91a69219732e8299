// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The sky behind a scene as a texture at infinity.
#pragma once
#include "ods/camera/texel_rays.h"
#include "ods/image/image.h"
#include "ods/scene/scene.h"

namespace ods {

// Returns the scene-linear radiance, 3 channels, that the camera sees behind the scene: the mean over each texel, which
// covers the directions of direction + x * across + y * down, with x and y from -1/2 to 1/2. So `across` and `down` are
// those of a texel at a distance of 1; `origin` does not matter. Texels of direction 0 are black.
Image sky_of(const Scene& scene, const TexelRays& rays);

}  // namespace ods
