// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The surfaces behind those that a picture shows, as far as eyes in a box may see them: what is behind an edge is taken
// to continue from there, at the same distance. Its colours are those of the other eye's picture if that shows the same
// surface, otherwise those at the edge, more and more mixed with increasing distance from it.
#pragma once
#include "ods/layers/depth/depth_panorama.h"

namespace ods {

// front: of look_from_middle(). grid: of the result, usually coarser, because its colours are smooth. reach: the
// largest distance of an eye from the middle, metres. Texels that hide nothing, or only the sky, show nothing.
DepthPanorama hidden_panorama(const Reprojection& picture, const DepthPanorama& front, const PageGrid& grid,
                              float reach);

}  // namespace ods
