// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

#include "ods/layers/file/glb_draft.h"
#include "ods/layers/file/layer_parts.h"

namespace ods {

// Adds the nodes of what moves, their animation, and the materials with the lights (ods/layers/file/write_layers.h). No
// effect if nothing moves. Returns the numbers of the textures with the changes of the still layers' light.
std::vector<size_t> add_film(Glb& glb, const LayeredScene& scene, const FilmTextures& textures);

}  // namespace ods
