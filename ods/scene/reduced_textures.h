// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Small copies of textures, for rays that look at them from all sides of a rough surface.
#pragma once
#include "ods/scene/scene.h"

namespace ods {

// Fills scene.reduced_textures and scene.reduced_texels from its textures: each at an eighth of its size, or as large
// as fits 65536 texels if that is more. Texels are means over area, of linear light where the texture has the sRGB
// curve.
void reduce_textures(Scene& scene);

}  // namespace ods
