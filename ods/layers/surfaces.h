// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The surfaces that a probe has seen, as simplified meshes.
#pragma once
#include <vector>

#include "ods/layers/probe.h"

namespace ods {

// One side of an instance, or the seen part of it. Triangles are counter-clockwise as seen from the box.
struct SeenSurface {
  int side = 0;         // 2 * instance + (1 if seen from the back), as in Probe::instances: in a mirror, perhaps
  bool masked = false;  // it has alpha
  float error = 0.0f;   // metres: triangles are at most about so far from the scene's own
  std::vector<vec3> positions;  // relative to the middle of the box
  std::vector<uvec3> triangles;
};

// The triangles that the probe saw with one ring of neighbours, which the rays between them may meet; simplified so that
// they move by half a pixel of the panorama at most, as seen from the box. pixel: in radians.
std::vector<SeenSurface> seen_surfaces(const Scene& scene, const Probe& probe, float pixel);

}  // namespace ods
