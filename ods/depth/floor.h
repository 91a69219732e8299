// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What depth says of the room that it is of: where its floor is, and whether it is upside down in depth.
#pragma once
#include <optional>

#include "ods/image/image.h"
#include "ods/kernel/camera/camera.h"

namespace ods {

// How far the floor is below the viewer, in the depth's own unit: the level plane, within a few degrees, that holds
// most of what is seen below (random sample consensus, Fischler and Bolles 1981). Nothing if no plane holds a third of
// it. nearness: 1 / unit, 1 channel; eye: as in camera_ray().
std::optional<double> floor_below(const Image& nearness, const Camera& camera, int eye);

// Whether depth is probably near where it says far. All signs must agree: what is below is farther away than what is
// level, what is above is no sky farther than both, and at edges of depth the lower side is mostly the farther one,
// while things that stand on a floor are in front of what shows above them.
bool looks_inverted(const Image& nearness, const Camera& camera, int eye);

}  // namespace ods
