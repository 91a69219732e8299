// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ods/layers/layered_scene.h"
#include "ods/scene/scene.h"

namespace ods {

// Returns a layered scene as a scene of unlit surfaces, visible from their front only, with displayed colours
// (Scene::as_painted). The sky is a cube that encloses everything. A mesh whose texture is empty is white. Instances
// are in the order of the meshes, without those that have no triangles, then those of a film as they are at its first
// frame.
Scene as_scene(const LayeredScene& layers);

}  // namespace ods
