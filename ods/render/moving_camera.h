// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The camera while the shutter is open.
#pragma once
#include <span>

#include "ods/kernel/camera/camera.h"

namespace ods {

// The camera at a time from 0, when the shutter opens, to 1, when it closes: interpolated between those of `cameras`,
// which are at even times and near each other. All but place and orientation is that of the middle one. Precondition:
// at least two.
Camera camera_at(std::span<const Camera> cameras, float time);

}  // namespace ods
