// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The holes of a layered scene, as its user meets them: measured from places that had no part in making it.
#pragma once
#include "ods/base/progress.h"
#include "ods/layers/layered_scene.h"
#include "ods/layers/probe.h"

namespace ods {

// Shares, 0..1, of the rays from other eyes in the box that meet a surface of the scene and none of the layers.
struct LayerHoles {
  double share = 0.0;  // of all rays
  double worst = 0.0;  // of one eye's
};

// Looks from 32 places in the box, evenly spread, along 55,296 rays each. hits: of the scene. Masked surfaces count as a
// whole. Throws Error(kCancelled).
LayerHoles find_holes(const FirstHits& hits, const LayeredScene& layers, const Progress& progress = {});

}  // namespace ods
