// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The light of a film's still layers, which changes by what moves: its shadows, its reflections, and lamps that move.
// It is traced with fewer texels than the layers themselves, once without what moves and once for each light of the
// film. The paths have the same random numbers, so where nothing that moves is met, the two are equal in spite of noise.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "ods/base/progress.h"
#include "ods/camera/texel_rays.h"
#include "ods/image/image.h"
#include "ods/layers/build_layers.h"
#include "ods/layers/light/light_layers.h"
#include "ods/render/renderer.h"

namespace ods {

// Coarse textures of a geometry's layers: a texel for each step x step of theirs.
struct CoarseLayers {
  std::shared_ptr<const TexelRays> rays;  // all textures below each other, size x size each
  int size = 0;
  int step = 1;
  float texels = 0.0f;  // across a layer's whole texture: its size / step
  size_t textures = 0;
};

// As sharp as a panorama of about this many texels around; that of the geometry has `width`. Panes of glass are empty.
inline constexpr int kCoarseWidth = 2048;
CoarseLayers coarse_layers(const LayerGeometry& geometry, int width);

// The displayed colours of these texels in linear light, 0..1, in the scene as it is. kept: as for kept_light().
Image coarse_light(const CoarseLayers& layers, const Renderer& renderer, const LayerLight& light,
                   const std::string& kept, const Progress& progress = {});

// The part of a texture whose light is another one at a moment.
struct ChangedPart {
  glm::ivec2 from{0}, to{0};  // coarse texels: from <= x < to
  Image codes;                // 3 channels, as LightChange::ratios
};

// By texture; parts where nothing changes by more than noise are empty.
std::vector<ChangedPart> changed_parts(const CoarseLayers& layers, const Image& before, const Image& now);

// Puts the parts of all lights into textures of one size that together have at most `most` bytes on graphics cards, if
// necessary by halving it. parts: by light.
LightChange light_change(const CoarseLayers& layers, std::span<const std::vector<ChangedPart>> parts, size_t most);

}  // namespace ods
