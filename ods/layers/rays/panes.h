// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Panes: smooth sheets of clear glass without a volume, which light passes straight. Rays that look for surfaces pass
// them; a layered scene draws them over what is behind.
#pragma once
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

// For each instance, whether it is a pane: of glass that transmits 95 % or more besides its tint, without textures,
// alpha, or layers. None if it comes nearer than `room` metres to a place along any axis: such a surface is in the way.
std::vector<char> find_panes(const Scene& scene, vec3 place, float room);

// The share of light that a pane reflects, and the mean over the colours of what it does not let through. cosine:
// between the ray and the pane's normal. As in ods/kernel/bsdf.h: one dielectric interface, and a tint.
float pane_reflectance(const Material& material, float cosine);
float pane_alpha(const Material& material, float cosine);

// The triangles of one side of an instance that face a place, counter-clockwise as seen from there: of its fronts, or of
// its backs, which are visible only if the material is double-sided. Positions are relative to the place.
struct PaneTriangles {
  std::vector<vec3> positions;
  std::vector<uvec3> triangles;
  float nearest = 0.0f;  // metres: at most the distance of the nearest of them
};
PaneTriangles pane_triangles(const Scene& scene, int instance, bool backs, vec3 place);

}  // namespace ods
