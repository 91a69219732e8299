// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The kernel's camera as JSON: the fields of struct Camera by their names, vectors as arrays. The page sets the
// uniforms of its shader from it, and so needs no formula of any camera.
#pragma once
#include "ods/base/json_reader.h"
#include "ods/kernel/camera/camera.h"

namespace ods {

// The pose is left out: a panorama is looked at in the camera's own frame. Maps have their texels, row by row, only
// where the place of a line of sight depends on them: with toe-in.
Json camera_json(const Camera& camera);

}  // namespace ods
