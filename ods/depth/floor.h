// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Derives from depth where the floor is, and whether depth is inverted.
#pragma once
#include <optional>

#include "ods/image/image.h"
#include "ods/kernel/camera/camera.h"

namespace ods {

// The distance of the floor below the viewer, in the depth's own unit: the level plane, within a few degrees, that
// contains most of the surfaces below (random sample consensus, Fischler and Bolles 1981). Returns nullopt if no plane
// contains a third of them. nearness: 1 / unit, 1 channel; eye: as in camera_ray().
std::optional<double> floor_below(const Image& nearness, const Camera& camera, int eye);

// Returns whether near and far are probably swapped. All of the following must hold: surfaces below are farther away
// than those at eye level; those above are not a sky farther than both; and at edges of depth the lower side is mostly
// the farther one, whereas objects on a floor are in front of the surfaces above them.
bool looks_inverted(const Image& nearness, const Camera& camera, int eye);

}  // namespace ods
