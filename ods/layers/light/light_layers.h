// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The light of a layered scene: path traced texel by texel, and displayed as in a picture.
#pragma once
#include "ods/image/tone.h"
#include "ods/layers/build_layers.h"
#include "ods/layers/light/bake.h"

namespace ods {

struct LayerLight {
  BakeOptions bake;
  float exposure = 0.0f;  // stops
  ToneCurve tone = ToneCurve::kNeutral;
};

// Renders the textures of a geometry that build_layers() made of this scene, and adds the sky if it is seen. Throws as
// bake() does.
LayeredScene light_layers(LayerGeometry geometry, const Scene& scene, const Renderer& renderer, const LayerLight& light,
                          const Progress& progress = {});

}  // namespace ods
