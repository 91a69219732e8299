// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The surfaces of a panorama with depth as triangles.
//
// Every texel is a quadrilateral around its direction. Texels of one surface share their corners; between surfaces the
// mesh is cut, along the texels' edges. Then it is simplified where that moves no point by more than half a pixel for
// eyes in the box: in a space in which a direction d with nearness n is the point d (1 + reach n). There, all movements
// that such eyes see have the same length: across the ray their angle in radians, along it the parallax of an eye that
// is `reach` metres away from the middle.
#pragma once
#include "ods/layers/depth/depth_panorama.h"
#include "ods/layers/surfaces.h"

namespace ods {

// reach: the largest distance of an eye from the middle, metres.
SeenSurface depth_surface(const DepthPanorama& panorama, float reach);

}  // namespace ods
