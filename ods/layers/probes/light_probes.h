// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Light probes for real-time objects in a layered scene: the light that arrives at places around the head box.
//
// The places are a grid within 4 m of the box's middle, from floor to ceiling, within the bounds of what the middle
// sees; 0.5 m apart, or more if there would be more than 512. A place is free if the middle sees it and no surface is
// within 10 cm.
//
// The light of a free place is path traced as for a point that scatters light evenly: paths start there in all
// directions, and each samples one light as well, weighted by the power heuristic (Veach 1997). So it contains what
// lights a surface there, not what a camera there sees: lamps without a size, lamps that the camera does not see or
// sees dimmed, and the environment instead of a background.
#pragma once
#include "ods/base/progress.h"
#include "ods/layers/layered_scene.h"
#include "ods/render/render_options.h"
#include "ods/scene/scene.h"

namespace ods {

inline constexpr int kMostProbes = 512;

struct ProbeOptions {
  int paths = 2048;      // of a probe
  RenderOptions render;  // bounces, clamp, caustics and seed are used
};

// Runs in the calling thread's TBB arena; the same arguments give the same bits. Returns no probes if no place is free.
// Throws Error(kCancelled).
LightProbes light_probes(const Scene& scene, const HeadBox& box, const ProbeOptions& options = {},
                         const Progress& progress = {});

// Sets the light of one place, whether it is free or not; weight is 1.
LightProbe light_at(const Scene& scene, vec3 place, const ProbeOptions& options = {});

}  // namespace ods
