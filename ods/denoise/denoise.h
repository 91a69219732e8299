// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Removes the noise of a path traced picture, both eyes as one, from what the renderer knows about each pixel.
//
// A pixel becomes a weighted mean of pixels around it, in growing windows. A pixel takes part if, given the variance of
// both, the two means do not differ significantly (Sakai et al., "A Statistical Approach to Monte Carlo Denoising",
// 2024), and if its normal and albedo are similar. Light is averaged without the albedo, so textures stay. Windows
// continue over the seam, the poles and the edges of cube faces. Where depth is known, the second set of candidates is
// the same surface in the other eye's picture: both eyes get the same light, and less noise.
//
// The picture converges to the truth: with more samples the variance falls and fewer pixels agree. A pixel whose
// variance is 0, as its neighbours', keeps its bits, and so does the bare sky (no hit, no normal).
#pragma once
#include "ods/base/names.h"
#include "ods/base/progress.h"
#include "ods/camera/stereo_camera.h"
#include "ods/picture/picture.h"

namespace ods {

// How a rendered picture is denoised.
enum class Denoiser {
  kNone,
  kOwn,   // denoise()
  kOidn,  // denoise_with_oidn() (ods/denoise/oidn.h)
};
inline constexpr NameRow<Denoiser> kDenoiserTable[] = {
    {Denoiser::kNone, "none"},
    {Denoiser::kOwn, "own"},
    {Denoiser::kOidn, "oidn"},
};
static_assert(has_every_member(kDenoiserTable));

struct DenoiseOptions {
  bool both_eyes = true;  // false: each eye alone
  int threads = 0;        // 0: all processors
};

// Replaces the radiance by the denoised one; the same bits for any number of threads. Needs the layer `variance`; uses
// `samples`, `normal`, `albedo` and `depth` if they are present. Variance that is NaN, infinite, negative, or of fewer
// than 2 samples counts as unknown and is taken from the neighbours. Radiance that is not finite becomes the mean of
// the neighbours, if there are any. Needs 28 bytes for each pixel beside the picture. Throws Error(kInput) if no pixel
// has a usable variance, Error(kMemory), Error(kCancelled). Precondition: one or two eyes of equal size with radiance
// and variance.
void denoise(Picture& picture, const StereoCamera& camera, const DenoiseOptions& options = {},
             const Progress& progress = {});

}  // namespace ods
