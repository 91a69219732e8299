// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Denoises with Intel Open Image Denoise, if the user has it installed: version 1 or 2, loaded on first use. It was
// trained on pictures and does not use statistics: it needs no variance, and does not converge to the truth.
//
// Every part of the picture that is one image of the world (a panorama, a face of a cube) is denoised with a margin of
// the adjacent parts of the world, and all parts of both eyes with one input scale. So there is no visible seam, and
// the eyes remain equally bright.
#pragma once
#include "ods/base/progress.h"
#include "ods/camera/stereo_camera.h"
#include "ods/picture/picture.h"

namespace ods {

// Throws Error(kInput) if the library is not installed; for checking before a long rendering.
void check_oidn();

// Replaces the radiance by the denoised one; uses albedo, and normals with it, if they are present. threads: 0 for all
// processors. Throws like check_oidn(); Error(kInput) if it fails; Error(kMemory); Error(kCancelled). Precondition: one
// or two eyes of equal size with radiance.
void denoise_with_oidn(Picture& picture, const StereoCamera& camera, int threads = 0, const Progress& progress = {});

}  // namespace ods
