// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The kernel's camera as JSON: the fields of struct Camera by their names, vectors as arrays. The page sets the
// uniforms of its shader from it, so the page does not contain camera formulas.
#pragma once
#include "ods/base/json_reader.h"
#include "ods/kernel/camera/camera.h"

namespace ods {

// Omits the pose: the page shows a panorama in the camera's own frame. Texels of maps are included, row by row,
// only if the place of a line of sight depends on them, with toe-in, or if places of points are wanted.
Json camera_json(const Camera& camera, bool has_points = false);

}  // namespace ods
