// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A layered scene of a picture with depth, without the scene that it shows: the surfaces of the picture, those behind
// them as far as eyes in the box may see them (ods/layers/depth/hidden_panorama.h), and the sky, which also closes
// what remains open.
#pragma once
#include <optional>

#include "ods/base/progress.h"
#include "ods/layers/layered_scene.h"
#include "ods/picture/stored_picture.h"

namespace ods {

struct PictureLayersOptions {
  vec3 box{0.3f};            // metres
  std::optional<int> width;  // of the panorama, texels; by default as sharp as the picture
  float exposure = 0.0f;     // stops; only for scene-linear pictures, and the tone curve, too
  ToneCurve tone = ToneCurve::kNeutral;
};

// Shares, 0..1, of what eyes in the box see, from 32 places.
struct PictureLayersCounts {
  size_t triangles = 0;
  double hidden = 0.0;  // surfaces that the picture does not show, of which only the colours at their edges are known
  double open = 0.0;    // the sky or the picture's own colours, where a surface ends and nothing is known behind it
};

// The box is around the picture's place, the middle of its viewing circle. Throws Error(kUsage) if the picture has no
// depth (ods/convert/reproject.h) or the box is too large for its surfaces; kMemory before the work begins; kCancelled.
LayeredScene picture_layers(const StoredPicture& picture, const PictureLayersOptions& options = {},
                            PictureLayersCounts* counts = nullptr, const Progress& progress = {});

}  // namespace ods
