// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The rays that find the light of pages and charts, texel by texel.
#pragma once
#include <vector>

#include "ods/layers/build_layers.h"
#include "ods/layers/charts.h"

namespace ods {

// Marks the texels of pages that a mesh's pieces of the state kPage read. read: by texel of all pages.
void mark_read(const PageGrid& grid, const PieceMesh& mesh, std::vector<char>& read);

// Adds the rays of texels that are read, and the texels that show another one's light. texture_of: by page.
void add_page_rays(const PanoramaPages& pages, const std::vector<char>& read, const std::vector<int>& texture_of,
                   LayerGeometry& geometry);

// Adds the rays of a chart's texels: from just in front of the surface, as the chart's place sees it. Texels beyond the
// surface's edge remain empty; those of masked surfaces get their coverage. Rays to what a mirror shows start in front of
// the mirror. Those of panes start on them, in the direction that they mirror for the middle, and the texels get the
// pane's alpha and reflectance. A piece of several texels none of which has a ray is dropped: it was kept because of
// tolerances, and would be in front of what hides it. Not in mirrors, where a chart's place does not see every piece.
// owner: of the texels. Safe from several threads at once for different charts.
void add_chart_rays(const FirstHits& hits, const Probe& probe, PieceMesh& mesh, const Chart& chart, int owner,
                    LayerGeometry& geometry);

}  // namespace ods
