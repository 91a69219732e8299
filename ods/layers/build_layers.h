// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The geometry of a layered scene: the scene's triangles that eyes in the head box see, with texture coordinates, and
// for every texel of their textures the ray that finds its light.
#pragma once
#include <cstddef>
#include <vector>

#include "ods/base/progress.h"
#include "ods/camera/texel_rays.h"
#include "ods/layers/holes.h"
#include "ods/layers/layered_scene.h"
#include "ods/scene/scene.h"

namespace ods {

// A texel beside a silhouette that shows the light of another texel.
struct PushedTexel {
  size_t to;
  size_t from;
};

struct LayerGeometry {
  LayeredScene scene;  // textures are empty: mesh i has texture i, rows i * size .. of the rays' table
  int texture_size = 0;
  bool sees_sky = false;
  TexelRays rays;                  // all textures below each other
  std::vector<float> coverage;     // of the rays' texels: 0..1, the alpha of glass; empty if nothing is masked or glass
  std::vector<float> reflectance;  // of the rays' texels: the share of their light; empty if there is no glass
  std::vector<int> claims;  // of the rays' texels: the owner of a texel that filters read and no ray lights; -1: none
  std::vector<PushedTexel> pushed;
};

// The size of a geometry, and of the scene that it shows.
struct LayerCounts {
  size_t seen_triangles = 0;  // of the scene
  size_t simplified_triangles = 0;
  size_t triangles = 0;
  size_t charts = 0;
  size_t mirrors = 0;      // whose reflections are geometry
  size_t panes = 0;        // of thin glass
  size_t page_texels = 0;  // that have light of their own
  size_t chart_texels = 0;
  LayerHoles holes;
};

// width: of the panorama in texels, as sharp as a lat-long picture of this width. Throws Error(kUsage) if the box cuts a
// surface, with the largest box that does not; Error(kMemory); Error(kCancelled).
LayerGeometry build_layers(const Scene& scene, const HeadBox& box, int width, LayerCounts* counts = nullptr,
                           const Progress& progress = {});

}  // namespace ods
