// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The camera while the shutter is open.
#pragma once
#include <span>

#include "ods/kernel/camera/camera.h"

namespace ods {

// The camera at a time from 0, when the shutter opens, to 1, when it closes. `cameras` are evenly spaced in time and
// close to each other; position and orientation are interpolated between them. Everything else is taken from the middle
// camera. Precondition: at least two cameras.
Camera camera_at(std::span<const Camera> cameras, float time);

}  // namespace ods
