// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture with depth as a panorama from the middle between its eyes, on the pages of a cube (ods/layers/page_grid.h).
// Directions and distances are relative to the middle of the viewing circle.
#pragma once
#include <cstddef>
#include <vector>

#include "ods/convert/reproject.h"
#include "ods/convert/resample.h"
#include "ods/image/image.h"
#include "ods/layers/page_grid.h"

namespace ods {

inline constexpr float kNothing = -1.0f;  // the nearness of a texel that shows nothing

// All values are page by page and row by row, and include the gutters, which show what is beyond the page's edge.
struct DepthPanorama {
  PageGrid grid;
  std::vector<vec3> colors;     // linear light
  std::vector<float> nearness;  // 1 / metres from the middle; 0: the sky; kNothing
};

// An empty panorama.
DepthPanorama empty_panorama(const PageGrid& grid);

// Looks from the middle of the viewing circle at the surfaces of a picture. Directions that the picture does not cover
// show nothing; those that neither of its eyes shows, the surface behind. Colours that pixels at the edges of surfaces
// mix are replaced by those of the nearest texels inside. reach: the largest distance of an eye
// from the middle, metres, which decides what is an edge.
DepthPanorama look_from_middle(const Reprojection& picture, const PageGrid& grid, float reach);

// The colour of a picture at a place, in linear light. values: room for the resampler's channels.
vec3 color_at(const Source& source, const Resampler& resampler, const Place& place, std::vector<float>& values);

// Returns whether a picture shows nothing but a surface at a place, and around it as far as filters read. nearness: of
// the surface.
bool shows_only(const Reprojection& picture, const Place& place, float nearness);

// The texel, not of a gutter, that shows a position in a page or just beyond its edge.
size_t inner_texel(const PageGrid& grid, int page, vec2 position);

// The texel, not of a gutter, that shows a direction.
size_t texel_towards(const PageGrid& grid, vec3 direction);

// Returns whether adjacent texels show one surface: eyes in the box would see no more than a pixel between them, or
// their distances differ by a few percent. reach: of eyes from the middle, metres. pixel: radians.
bool shows_one_surface(float a, float b, float reach, float pixel);

// As above, or the surface continues from `a` as it arrives from `before`, or from `b` to `after`: a surface at a
// grazing angle. Any of them may be kNothing or 0.
bool continues(float before, float a, float b, float after, float reach, float pixel);

}  // namespace ods
