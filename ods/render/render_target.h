// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The picture that a device renders into.
#pragma once
#include "ods/camera/stereo_camera.h"
#include "ods/picture/picture.h"
#include "ods/render/render_options.h"

namespace ods {

// The options with the height that `stereo`'s projection has by nature, where they say none. Preconditions: those of
// RenderOptions' fields.
RenderOptions with_height(RenderOptions options, const StereoCamera& stereo);

// Throws Error(kMemory) where there is not enough for the picture. Precondition: options.height > 0.
void check_picture_memory(const RenderOptions& options);

// Black, of the options' size, eyes and layers. Precondition: options.height > 0.
Picture blank_picture(const RenderOptions& options);

}  // namespace ods
