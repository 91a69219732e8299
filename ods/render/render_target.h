// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The picture that a device renders into.
#pragma once
#include "ods/camera/stereo_camera.h"
#include "ods/picture/picture.h"
#include "ods/render/render_options.h"

namespace ods {

// Returns the options, with the natural height of `stereo`'s projection if no height is set. Preconditions: those of
// RenderOptions' fields.
RenderOptions with_height(RenderOptions options, const StereoCamera& stereo);

// Returns the options for a picture of texel_camera(): the table's size, one eye, and the box filter, because texels do
// not overlap.
RenderOptions with_texels(RenderOptions options, int width, int height);

// Returns whether a picture of this camera may have these options. If the camera has a table of rays, they have what
// with_texels() sets.
bool fit_camera(const RenderOptions& options, const StereoCamera& stereo);

// The memory for rendering, bytes: the samples and the Picture. Precondition: options.height > 0.
size_t picture_bytes(const RenderOptions& options);

// Throws Error(kMemory) if there is not enough memory for the picture. Precondition: options.height > 0.
void check_picture_memory(const RenderOptions& options);

// A black picture of one eye with the options' size and layers. Precondition: options.height > 0.
EyeImage blank_eye(const RenderOptions& options, int eye);

}  // namespace ods
