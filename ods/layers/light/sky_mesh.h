// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The sky as a layer at infinity: a cube, whose faces are divided evenly by angle as in ods/layers/page_grid.h.
#pragma once
#include <vector>

#include "ods/image/tone.h"
#include "ods/layers/layered_scene.h"
#include "ods/scene/scene.h"

namespace ods {

// The background of a scene, as displayed with an exposure in stops and a tone curve. largest: of a texture, texels.
// Positions are relative to the eye.
std::vector<LayerMesh> make_sky(const Scene& scene, int largest, float exposure, ToneCurve tone);

}  // namespace ods
