// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Intel Open Image Denoise in the denoiser's place, where the user has it: version 1 or 2, opened when it is first
// asked for. It learns from pictures, not from statistics: it needs no variance, and does not converge to the truth.
//
// Every part of the picture that is one image of the world (a panorama, a face of a cube) is denoised with a margin of
// what the world has beyond its edges, and all parts of both eyes with one input scale: so no seam shows, and the eyes
// stay equally bright.
#pragma once
#include "ods/base/progress.h"
#include "ods/camera/stereo_camera.h"
#include "ods/picture/picture.h"

namespace ods {

// Throws Error(kInput) if it is not installed: for callers who would learn that too late.
void check_oidn();

// Replaces the radiance by the denoised one; uses albedo, and normals beside it, if they are present. threads: 0 for
// all processors. Throws as check_oidn(); Error(kInput) if it fails; Error(kMemory); Error(kCancelled). Precondition:
// one or two eyes of equal size with radiance.
void denoise_with_oidn(Picture& picture, const StereoCamera& camera, int threads = 0, const Progress& progress = {});

}  // namespace ods
