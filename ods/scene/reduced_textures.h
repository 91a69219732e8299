// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Small copies of textures, for rays that hit them after a rough bounce.
#pragma once
#include "ods/scene/scene.h"

namespace ods {

// Fills scene.reduced_textures and scene.reduced_texels: each texture at an eighth of its size, or as large as fits
// 65536 texels if that is more. Texels are area averages, in linear light for sRGB textures; for kTexelNormal, mean
// directions.
void reduce_textures(Scene& scene);

}  // namespace ods
